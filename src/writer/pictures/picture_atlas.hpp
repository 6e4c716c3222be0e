// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "image/picture.hpp"

namespace cloudgen::writer {

/// Pictures of any size side by side in one texture: viewers wait for each texture that they load.
class PictureAtlas {
 public:
  explicit PictureAtlas(std::span<const image::ByteImage* const> pictures);

  const image::ByteImage& texture() const { return texture_; }
  /// A rectangle of a picture (left, top, right, bottom in its pixels) as u0, v0, u1, v1.
  glm::vec4 textureBox(std::size_t picture, const glm::ivec4& pixels) const;

 private:
  std::vector<glm::ivec2> corners_;
  image::ByteImage texture_;
};

}  // namespace cloudgen::writer
