// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/genus.hpp"
#include "base/progress.hpp"
#include "image/picture.hpp"
#include "image/sprite_maps.hpp"

namespace cloudgen::image {

inline constexpr int kSpriteTilePixels = 128, kSpriteTilesAcross = 4;

/// The sprite atlas of a genus: 4 x 4 tiles of 128 pixels, grey and straight alpha, display-encoded. Grey,
/// because VRML97 and X3D 3 let a texture of three colours replace the vertex colours (X3DOM does), and a
/// grey one modulate them. Each tile is a small cloud of noise, lit from above and seen from the side: alpha
/// has the mean of the Gaussian that it stands for (kSpriteReach) and is zero on the tile's border; colour is
/// defined under zero alpha too, so that filtering makes no dark fringe.
/// With maps, for engines that light sprites themselves: see SpriteMaps.
struct SpriteSheets {
  ByteImage color;
  std::optional<SpriteMaps> maps;
};
SpriteSheets bakeSprites(base::Genus genus, bool withMaps);

/// Each pixel the mean of four: light is smooth.
ByteImage halved(const ByteImage& image);

/// Writes every genus's atlas, its six-way light maps at half the resolution (GENUS.sixway_a.png, GENUS.sixway_b.png) and
/// manifest.json into a folder that exists; where asked also GENUS.normal.png. The set in textures/ is the one without.
void writeSpriteSet(const std::filesystem::path& folder, bool withNormals, const base::Progress& progress);

}  // namespace cloudgen::image
