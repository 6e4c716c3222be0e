// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "image/sprite_atlas.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer::gltf {

/// A triangle mesh in an archetype's own axes, as columns ready for glTF.
struct CardMesh {
  std::vector<float> positions;        ///< xyz, metres
  std::vector<float> textureBoxes;     ///< uv, origin at the upper left
  std::vector<std::uint16_t> colors;   ///< linear RGB and alpha, 65535 = 1
  std::vector<float> opticalDepths;    ///< of the card that a vertex belongs to: what alpha, near 1, tells no more
  std::vector<std::uint32_t> indices;  ///< triangles
};

/// Three mutually perpendicular cards a far puff, each a grid of 2 x 2 cells that reaches 2.2 standard
/// deviations, with the puff's sprite. Vertices take the light of the puffs around them, so a card is bright
/// on top and dark below as the cloud is. Seen from straight above, the cards hold the extinction of the puff
/// (times `opticalDepthFactor`), the lying one wider where it is dense (shape::blendedWidening); each upright
/// one has half of the optical depth of the puff at its broadest, as a level look meets two.
CardMesh cardsOf(const scene::Archetype& archetype, const scene::LitArchetype& lit, float opticalDepthFactor,
                 const image::SpriteAtlas& atlas);

}  // namespace cloudgen::writer::gltf
