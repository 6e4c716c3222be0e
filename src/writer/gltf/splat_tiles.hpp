// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::gltf {

/// Viewers order the splats of one primitive among themselves, and primitives as wholes: few tiles
/// (scene::tilesOf) look better than many.
inline constexpr std::size_t kMostSplatsOfTile = 200'000;
/// The middle of a tile's box, in whole metres, so that it is exact as a float and short as a text.
glm::dvec3 tileCenter(const scene::Tile& tile);

/// The visible puffs of a tile's clouds as splats, their centres relative to the tile's, in Morton order, equal
/// places by instance and puff.
std::vector<Splat> splatsOf(const scene::Scene& scene, const scene::Tile& tile);

}  // namespace cloudgen::writer::gltf
