// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::image {

/// A sprite stands for a Gaussian that is cut off all around at its border: half its side in deviations, and the
/// share of the Gaussian within, 1 - exp(-2.2^2 / 2).
inline constexpr float kSpriteReach = 2.2f, kWithinSprite = 0.9111f;

/// One square texture of sprites a genus: `columns` x `rows` tiles, numbered row by row from the top left.
struct SpriteAtlas {
  base::Genus genus{};
  std::string file;              ///< within the textures folder
  std::string sixwayA, sixwayB;  ///< its light maps (SpriteMaps), there, at half its resolution; empty: none
  int columns = 1, rows = 1, tilePixels = 0;

  int tiles() const { return columns * rows; }
  /// (u0, v0, u1, v1) of a tile, origin at the lower left as in X3D; half a texel inside the tile.
  glm::vec4 textureBox(int tile) const;
};

/// Reads textures/manifest.json: one atlas a genus. Throws InputError if it is missing, malformed or lacks a
/// genus.
std::vector<SpriteAtlas> readSpriteManifest(const std::filesystem::path& texturesFolder);

/// The atlas of a genus; there always is one in what readSpriteManifest returned.
const SpriteAtlas& atlasOf(const std::vector<SpriteAtlas>& atlases, base::Genus genus);

}  // namespace cloudgen::image
