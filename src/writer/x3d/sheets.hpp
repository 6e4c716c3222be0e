// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "writer/pictures/picture_atlas.hpp"
#include "writer/pictures/puff_painting.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// The clouds of a square as a level picture from above: far off, where clouds are flat against how far they
/// reach, a viewer sees hardly more, and blends one pixel instead of dozens of cards over each other.
struct Sheet {
  PuffPicture picture;              ///< along x and -z
  std::vector<glm::ivec4> patches;  ///< left, top, right, bottom of what is not empty, in pixels
};

/// Paints instances with their puffs, so many pixels along the longer side.
Sheet sheetOf(const scene::Scene& scene, std::span<const std::uint32_t> instances, int pixels);

/// The patches of a sheet that is a picture of an atlas, both their faces.
QuadMesh meshOf(const Sheet& sheet, const PictureAtlas& atlas, std::size_t picture);

}  // namespace cloudgen::writer
