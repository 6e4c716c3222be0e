// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>

#include "writer/x3d/card_picture.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/tile_tree.hpp"

namespace cloudgen::writer {

/// Textures of the genera of a scene, for drawing with them here.
class SpriteSheets {
 public:
  /// Throws InputError if a texture cannot be read.
  SpriteSheets(const scene::Scene& scene, const std::vector<image::SpriteAtlas>& atlases,
               const std::filesystem::path& textures);
  const SpriteSheet& of(base::Genus genus) const { return sheets_.at(genus); }

 private:
  std::map<base::Genus, SpriteSheet> sheets_;
};

/// A tile from afar. Clouds that turn to the viewer are pictures of themselves, on cards that face the side
/// they are seen from. All others are crossed cards.
struct TileViews {
  std::string texture;  ///< in the textures folder; empty if no cloud is a picture
  std::array<QuadMesh, kViews> sides;
  std::vector<std::uint32_t> others;  ///< instances
};

/// Draws the pictures of a tile at `metersPerPixel` and writes their texture. Throws OutputError.
TileViews drawViews(const scene::Scene& scene, const TileNode& tile, float metersPerPixel,
                    const std::vector<image::SpriteAtlas>& atlases, const SpriteSheets& sprites,
                    const std::filesystem::path& textures);

/// Writes them as nodes of the open one: LODs about far points choose the side that the viewer is at.
void writeViews(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const TileNode& tile,
                const TileViews& views);

}  // namespace cloudgen::writer
