// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GLES3/gl3.h>

#include <utility>

#include "runtime/status.hpp"
#include "runtime/vec3.hpp"

namespace cloudgen::runtime::gles {

/// Something of OpenGL that is deleted with this, in the context that was current when it was made.
template <void (*Delete)(GLuint)>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint id) : id_(id) {}
  ~Object() { reset(); }
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, 0);
    }
    return *this;
  }
  GLuint id() const noexcept { return id_; }

 private:
  void reset() noexcept {
    if (id_ != 0) Delete(id_);
    id_ = 0;
  }
  GLuint id_ = 0;
};

inline void deleteTexture(GLuint id) { glDeleteTextures(1, &id); }
inline void deleteBuffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void deleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void deleteVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void deleteProgram(GLuint id) { glDeleteProgram(id); }

using Texture = Object<deleteTexture>;
using Buffer = Object<deleteBuffer>;
using Framebuffer = Object<deleteFramebuffer>;
using VertexArray = Object<deleteVertexArray>;
using Program = Object<deleteProgram>;

Texture newTexture() noexcept;
Buffer newBuffer() noexcept;
VertexArray newVertexArray() noexcept;

/// How a texture is read between its texels and beyond its border.
enum class Filter { Nearest, Linear, Mipmaps };
enum class Border { Clamp, Repeat };

/// An immutable two-dimensional texture of one level, or of all for Filter::Mipmaps.
Texture newTexture2d(GLenum format, int width, int height, Filter filter, Border border) noexcept;

/// A framebuffer that draws into a texture.
Framebuffer newFramebuffer(const Texture& color) noexcept;

/// Compiles and links "#version 300 es" shaders: `common` comes before either.
Status makeProgram(const char* common, const char* vertex, const char* fragment, Program& program) noexcept;

/// Where a uniform is; -1, which OpenGL ignores, where the program has none of the name.
inline GLint uniform(const Program& program, const char* name) noexcept { return glGetUniformLocation(program.id(), name); }

void setVec3(const Program& program, const char* name, const Vec3& v) noexcept;

/// Binds a texture to a unit and makes a sampler of the current program read it.
void bindTexture(const Program& program, const char* sampler, int unit, GLenum target, const Texture& texture) noexcept;

}  // namespace cloudgen::runtime::gles
