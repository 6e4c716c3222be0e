// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "image/picture.hpp"
#include "scene/scene.hpp"
#include "shape/puff.hpp"
#include "writer/pictures/relief.hpp"

namespace cloudgen::writer {

/// A puff with the colour that it is painted in, sRGB.
struct ColoredPuff {
  shape::Puff puff;
  glm::vec3 color{1};
};

/// A way of looking with parallel rays, by unit vectors: right x up looks towards the viewer.
struct Sight {
  glm::vec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};
};

/// A picture of puffs on the plane of a sight.
struct PuffPicture {
  image::ByteImage image;  ///< straight alpha, sRGB, its first row upmost; hardly anything at the border
  glm::vec2 lower{0}, upper{0};  ///< its corners, along right and up, metres
  float surface = 0;             ///< mean place of what is seen, along towards, metres
  Relief relief;                 ///< if it was asked for
};

/// Rectangles around what is seen (left, top, right, bottom in pixels), so many cells along the longer side
/// looked at: nothing transparent is drawn that need not be.
std::vector<glm::ivec4> patchesOf(const image::ByteImage& picture, int cells);

/// Paints puffs from far to near as their Gaussians, out to where they end; with a relief of so many cells
/// along the longer side, or none.
PuffPicture paintedPuffs(std::span<const ColoredPuff> puffs, const Sight& sight, float pixelsPerMeter,
                         int reliefCells = 0);
/// The same with so many pixels along the longer side.
PuffPicture paintedPuffs(std::span<const ColoredPuff> puffs, const Sight& sight, int pixels);

}  // namespace cloudgen::writer
