// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "writer/x3d/card_picture.hpp"

namespace cloudgen::writer {

/// Pictures in one texture, and where each lies in it: u0, v0, u1, v1 from the lower left.
struct PictureAtlas {
  image::ByteImage pixels;
  std::vector<glm::vec4> boxes;
};

/// Puts pictures on shelves, the high ones first.
PictureAtlas packed(std::span<const CardPicture> pictures);

}  // namespace cloudgen::writer
