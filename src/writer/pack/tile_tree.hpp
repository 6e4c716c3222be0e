// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <vector>

#include "scene/scene.hpp"

namespace cloudgen::writer::packed {

/// The clouds of a scene as a tree of boxes, as schemas/runtime_pack.fbs says: low, middle and high ones apart,
/// then cut across the longer side again and again, at most 32 in a leaf and 8 children a tile.
struct TileTree {
  std::vector<std::uint32_t> order;  ///< indices in Scene::instances, as the pack lists them
  std::vector<pack::Tile> tiles;     ///< parents before children; a root without clouds for an empty scene
};

TileTree tileTreeOf(const scene::Scene& scene);

}  // namespace cloudgen::writer::packed
