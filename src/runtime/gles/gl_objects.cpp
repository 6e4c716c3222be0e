// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/gl_objects.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace cloudgen::runtime::gles {
namespace {

void deleteShader(GLuint id) { glDeleteShader(id); }
using Shader = Object<deleteShader>;

Shader compiled(GLenum kind, const char* common, const char* source) noexcept {
  const std::array<const char*, 3> parts{"#version 300 es\nprecision highp float;\nprecision highp int;\n", common, source};
  Shader shader(glCreateShader(kind));
  glShaderSource(shader.id(), static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  glCompileShader(shader.id());
  return shader;
}

}  // namespace

Texture newTexture() noexcept {
  GLuint id = 0;
  glGenTextures(1, &id);
  return Texture(id);
}

Buffer newBuffer() noexcept {
  GLuint id = 0;
  glGenBuffers(1, &id);
  return Buffer(id);
}

VertexArray newVertexArray() noexcept {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return VertexArray(id);
}

Texture newTexture2d(GLenum format, int width, int height, Filter filter, Border border) noexcept {
  Texture texture = newTexture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  const int levels =
      filter == Filter::Mipmaps ? std::bit_width(static_cast<unsigned>(std::max(width, height))) : 1;
  glTexStorage2D(GL_TEXTURE_2D, levels, format, width, height);
  const GLint enlarged = filter == Filter::Nearest ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, enlarged);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter == Filter::Mipmaps ? GL_LINEAR_MIPMAP_LINEAR : enlarged);
  const GLint wrap = border == Border::Repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  return texture;
}

Framebuffer newFramebuffer(const Texture& color) noexcept {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  Framebuffer framebuffer(id);
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.id(), 0);
  return framebuffer;
}

Status makeProgram(const char* common, const char* vertex, const char* fragment, Program& program) noexcept {
  const Shader first = compiled(GL_VERTEX_SHADER, common, vertex), second = compiled(GL_FRAGMENT_SHADER, common, fragment);
  Program linked(glCreateProgram());
  glAttachShader(linked.id(), first.id());
  glAttachShader(linked.id(), second.id());
  glLinkProgram(linked.id());
  GLint done = 0;
  glGetProgramiv(linked.id(), GL_LINK_STATUS, &done);
  if (!done) return {"the driver does not compile a shader"};
  program = std::move(linked);
  return {};
}

void setVec3(const Program& program, const char* name, const Vec3& v) noexcept {
  glUniform3f(uniform(program, name), v.x, v.y, v.z);
}

void bindTexture(const Program& program, const char* sampler, int unit, GLenum target, const Texture& texture) noexcept {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(target, texture.id());
  glUniform1i(uniform(program, sampler), unit);
}

}  // namespace cloudgen::runtime::gles
