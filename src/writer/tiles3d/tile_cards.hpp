// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "image/sprite_atlas.hpp"
#include "writer/gltf/card_mesh.hpp"
#include "writer/gltf/glb_file.hpp"
#include "writer/tiles3d/placed_puff.hpp"
#include "writer/tiles3d/placement.hpp"

namespace cloudgen::writer::tiles3d {

/// The cards that a tile draws of a puff: gltf::cardsOf without upright ones that are narrow or faint.
std::vector<gltf::Card> tileCardsOf(const shape::Puff& puff);

/// Adds a node a genus with the cards of its puffs on a plane, the lowest first, two triangles each. Sprites are
/// "../textures/" and the file of the genus's atlas. Returns how many cards there are.
std::size_t addCards(gltf::GlbFile& file, const TilePlane& plane, const Placement& placement,
                     std::span<const PlacedPuff> puffs, const std::vector<image::SpriteAtlas>& atlases);

}  // namespace cloudgen::writer::tiles3d
