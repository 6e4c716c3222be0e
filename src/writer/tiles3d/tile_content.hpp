// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>

#include "base/genus.hpp"
#include "writer/format.hpp"
#include "writer/tiles3d/placement.hpp"
#include "writer/tiles3d/region.hpp"
#include "writer/tiles3d/tile_tree.hpp"

namespace cloudgen::writer::tiles3d {

/// What the tileset must know of a tile that was written.
struct WrittenTile {
  TilePlane plane;
  Region region;  ///< of its splats, out to three deviations
  std::size_t splats = 0;
  std::set<base::Genus> genera;
  double lowestBaseMeters = 0, highestTopMeters = 0;
};

/// The extensions that tiles of this content use and require.
std::vector<std::string> extensionsOf(TileContent content);

/// Writes the GLB of a tile: its splats on the plane at their middle, by one node. Throws OutputError.
WrittenTile writeTile(const scene::Scene& scene, const TileTree& tree, const TileNode& node,
                      const TilesOptions& options, const std::filesystem::path& file);

}  // namespace cloudgen::writer::tiles3d
