// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/puff_brush.hpp"

#include <algorithm>
#include <cstddef>
#include <new>
#include <string>

#include "runtime/gles/shaders.hpp"

namespace cloudgen::runtime::gles {
namespace {

constexpr float kHazeHeightMeters = 2200, kHazeLengthMeters = 42'000;

/// As shader::kPuffVertex lays it out (std140).
struct Locks {
  std::uint32_t puff[kMostLocked][4];
  float facing[kMostLocked][4];
};

}  // namespace

void useProgram(const Program& program, const Camera& camera, const Runtime& runtime) noexcept {
  glUseProgram(program.id());
  const Vec3 forward = normalized(camera.forward), right = normalized(cross(forward, camera.up)), up = cross(right, forward);
  const float focal = camera.focalPixels();
  setVec3(program, "uEye", camera.eye);
  setVec3(program, "uRight", right);
  setVec3(program, "uUp", up);
  setVec3(program, "uForward", forward);
  glUniform2f(uniform(program, "uLens"), 2 * focal / static_cast<float>(camera.widthPixels),
              2 * focal / static_cast<float>(camera.heightPixels));
  setVec3(program, "uSun", runtime.lighting().sunDirection());
  glUniform1f(uniform(program, "uGround"), runtime.groundMeters());
  const float perMeter = std::exp(-std::max(0.0f, camera.eye.y) / kHazeHeightMeters) / kHazeLengthMeters;
  glUniform2f(uniform(program, "uHaze"), perMeter, kHazeHeightMeters);
}

void drawQuads(const VertexArray& array, const Buffer& pairs, std::size_t first, std::size_t count) noexcept {
  constexpr std::size_t kPair = 2 * sizeof(std::uint32_t);
  glBindVertexArray(array.id());
  glBindBuffer(GL_ARRAY_BUFFER, pairs.id());
  glEnableVertexAttribArray(0);
  glVertexAttribDivisor(0, 1);
  glVertexAttribIPointer(0, 2, GL_UNSIGNED_INT, kPair, reinterpret_cast<const void*>(first * kPair));
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

Status PuffBrush::make(const Runtime& runtime, const PackTextures& textures) noexcept {
  runtime_ = &runtime;
  textures_ = &textures;
  try {
    const std::string readers = std::string(shader::kCommon) + PackTextures::kReaders;
    if (const Status made = makeProgram(readers.c_str(), shader::kPuffVertex, shader::kPuffFragment, program_); !made) return made;
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the shaders"};
  }
  array_ = newVertexArray();
  locks_ = newBuffer();
  glBindBuffer(GL_UNIFORM_BUFFER, locks_.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(Locks), nullptr, GL_DYNAMIC_DRAW);
  glUniformBlockBinding(program_.id(), glGetUniformBlockIndex(program_.id(), "Locks"), 0);
  return {};
}

void PuffBrush::begin(const Camera& camera, const Texture& sky, float pixel, std::span<const FacingLock::Locked> locked) noexcept {
  useProgram(program_, camera, *runtime_);
  const int unit = textures_->bind(program_, 0);
  bindTexture(program_, "uSky", unit, GL_TEXTURE_2D, sky);
  setVec3(program_, "uCameraUp", camera.up);
  glUniform1f(uniform(program_, "uPixel"), pixel);
  glUniform1i(uniform(program_, "uLocked"), static_cast<GLint>(locked.size()));
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, locks_.id());
  for (std::size_t i = 0; i < locked.size(); ++i) {
    const auto& [puff, facing] = locked[i];
    const std::uint32_t name[4]{puff.instance, puff.puff, 0, 0};
    const float way[4]{facing.x, facing.y, facing.z, 0};
    glBufferSubData(GL_UNIFORM_BUFFER, static_cast<GLintptr>(offsetof(Locks, puff) + i * sizeof(name)), sizeof(name), name);
    glBufferSubData(GL_UNIFORM_BUFFER, static_cast<GLintptr>(offsetof(Locks, facing) + i * sizeof(way)), sizeof(way), way);
  }
}

void PuffBrush::setClear() noexcept { glUniform2f(uniform(program_, "uHaze"), 0, kHazeHeightMeters); }

void PuffBrush::draw(const Buffer& puffs, std::size_t first, std::size_t count) const noexcept {
  drawQuads(array_, puffs, first, count);
}

}  // namespace cloudgen::runtime::gles
