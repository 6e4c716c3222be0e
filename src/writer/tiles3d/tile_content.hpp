// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>

#include "base/genus.hpp"
#include "image/sprite_atlas.hpp"
#include "writer/format.hpp"
#include "writer/tiles3d/placement.hpp"
#include "writer/tiles3d/region.hpp"
#include "writer/tiles3d/tile_tree.hpp"

namespace cloudgen::writer::tiles3d {

/// What the tileset must know of a tile that was written.
struct WrittenTile {
  TilePlane plane;
  Region region;          ///< of what it draws; of splats out to three deviations
  std::size_t drawn = 0;  ///< splats or cards
  std::set<base::Genus> genera;
  double lowestBaseMeters = 0, highestTopMeters = 0;
};

/// The extensions that tiles of this content use and require.
std::vector<std::string> extensionsOf(TileContent content);

/// Packed splats, if all of the root can be drawn in splats as narrow as CesiumJS wants them and at most twice as
/// many, else cards.
TileContent chosenContent(const scene::Scene& scene, const TileTree& tree);

/// How tiles are drawn.
struct TileStyle {
  TileContent content = TileContent::Packed;  ///< not Auto
  int degree = 1;                             ///< of the harmonics of splats
  bool gzip = false;
  std::vector<image::SpriteAtlas> atlases;  ///< of cards
};

/// Writes the GLB of a tile: its splats or cards on the plane at their middle. Throws OutputError.
WrittenTile writeTile(const scene::Scene& scene, const TileTree& tree, const TileNode& node,
                      const TileStyle& style, const std::filesystem::path& file);

}  // namespace cloudgen::writer::tiles3d
