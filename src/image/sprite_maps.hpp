// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "image/picture.hpp"

namespace cloudgen::image {

/// What an engine lights a sprite with, RGBA, linear, tile for tile as the atlas; alpha is the sprite's, and
/// the values are defined under zero alpha too.
struct SpriteMaps {
  ByteImage normal;   ///< mean normal of what is seen, x right, y up, z to the eye, as 0.5 + 0.5 n
  ByteImage sixwayA;  ///< brightness under light from the right, from above, from behind
  ByteImage sixwayB;  ///< from the left, from below, from the eye
};

/// One place of a sprite: normal and the light from +x, +y, +z (away from the eye), -x, -y, -z.
struct MapTexel {
  glm::vec3 normal{0, 0, 1};
  std::array<float, 6> light{};
};

/// A volume of spriteVolume as seen along z, kSpriteVolume^2 texels, rows from below. Each light thins by the
/// optical depth on its way in; sampled by orders of scattering as light::transmitted.
std::vector<MapTexel> mapsFromTheSide(const std::vector<float>& volume);

/// Writes the texel at (u, v) of 0..1, v upwards, into pixel (x, y) of the maps.
void paintMaps(SpriteMaps& maps, const std::vector<MapTexel>& texels, double u, double v, int x, int y,
               unsigned char alpha);

}  // namespace cloudgen::image
