// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "writer/pictures/puff_painting.hpp"

namespace cloudgen::writer {

/// A picture as triangles with a colour at each corner, small ones where it changes: as bright as the picture, and
/// covering as much. Viewers draw such a pixel in a tenth of the time that one of a texture takes (X_ITE 15 looks up no
/// texture without two Perlin noises), and nothing is drawn where nothing is seen.
struct PictureMesh {
  std::vector<glm::vec2> points;       ///< on the picture's plane, metres along right and up
  std::vector<glm::vec4> colors;       ///< sRGB code values and opacity, 0..1
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise
  /// What it shows otherwise than the picture (mean over opacity and premultiplied colours, times area) to the length
  /// of the picture's border: by so much a sharp outline of the picture's size would have to lie elsewhere.
  float missMeters = 0;
};

/// One for each number, which rise: of at most so many triangles, fewer where the picture needs no more.
std::vector<PictureMesh> meshesOf(const PuffPicture& picture, std::span<const std::size_t> mostTriangles);

}  // namespace cloudgen::writer
