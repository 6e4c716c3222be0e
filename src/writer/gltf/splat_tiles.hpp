// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer::gltf {

/// Viewers order the splats of one primitive among themselves, and primitives as wholes: few tiles
/// (scene::tilesOf) look better than many.
inline constexpr std::size_t kMostSplatsOfTile = 200'000;
/// Below this a splat is not seen: 8-bit viewers round it to one step or none.
inline constexpr float kLeastOpacity = 0.004f;

/// A puff as a Gaussian splat, its centre relative to the tile's.
struct Splat {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opacity = 0;
  float opticalDepth = 0;   ///< through the centre, along the shortest axis
  glm::vec3 color{0};       ///< sRGB-encoded, 0..1: what degree 0 stands for
  glm::vec3 towardsSun{0};  ///< sRGB-encoded: what degree 1 adds at full when one looks straight at the sun
};

/// 1 - exp(-optical depth) of a puff along its shortest axis.
float splatOpacity(const shape::Puff& placedPuff);

/// The middle of a tile's box, in whole metres, so that it is exact as a float and short as a text.
glm::dvec3 tileCenter(const scene::Tile& tile);

/// The visible puffs of a tile's clouds as splats, in Morton order of their places (three interleaved
/// coordinates of 16 bits; Morton 1966), equal places by instance and puff.
std::vector<Splat> splatsOf(const scene::Scene& scene, const scene::Tile& tile);

}  // namespace cloudgen::writer::gltf
