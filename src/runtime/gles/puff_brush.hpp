// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/facing.hpp"
#include "runtime/gles/gl_objects.hpp"
#include "runtime/gles/pack_textures.hpp"
#include "runtime/runtime.hpp"

namespace cloudgen::runtime::gles {

/// Makes a program current and tells it where the camera, the sun and the ground are (shader::kCommon).
void useProgram(const Program& program, const Camera& camera, const Runtime& runtime) noexcept;

/// Draws runs of puffs into the framebuffer that is bound, back to front.
class PuffBrush {
 public:
  Status make(const Runtime& runtime, const PackTextures& textures) noexcept;
  /// Before any draw of a frame. `pixel` is the slope that one spans.
  void begin(const Camera& camera, const Texture& sky, float pixel, std::span<const FacingLock::Locked> locked) noexcept;
  /// Goes on without the haze before the clouds.
  void setClear() noexcept;
  /// Those of a buffer from a place on.
  void draw(const Buffer& puffs, std::size_t first, std::size_t count) const noexcept;

 private:
  const Runtime* runtime_ = nullptr;
  const PackTextures* textures_ = nullptr;
  Program program_;
  Buffer locks_;
  VertexArray array_;
};

/// Four corners for each of `count` pairs of numbers of a buffer, to the program that is current.
void drawQuads(const VertexArray& array, const Buffer& pairs, std::size_t first, std::size_t count) noexcept;

}  // namespace cloudgen::runtime::gles
