// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/puff.hpp"
#include "writer/gltf/glb_file.hpp"

namespace cloudgen::writer::gltf {

/// A rectangle with a sprite.
struct Card {
  glm::vec3 center{0}, right{0}, up{0};  ///< half-sides, 2.2 standard deviations of the sprite long
  float opticalDepth = 0;                ///< of its centre
  bool upright = false;                  ///< not the one of the three that lies
};

/// Three mutually perpendicular cards of a puff. Seen from straight above they hold the extinction of the puff
/// (times `opticalDepthFactor`), the lying one wider where it is dense (shape::blendedWidening); each upright one
/// has half of the optical depth of the puff at its broadest, as a level look meets two.
std::array<Card, 3> cardsOf(const shape::Puff& puff, float opticalDepthFactor);

/// A triangle mesh, as columns ready for glTF.
struct CardMesh {
  std::vector<float> positions;        ///< xyz, metres
  std::vector<float> textureBoxes;     ///< uv, origin at the upper left
  std::vector<std::uint16_t> colors;   ///< linear RGB and alpha, 65535 = 1
  std::vector<float> opticalDepths;    ///< of the card that a vertex belongs to: what alpha, near 1, tells no more
  std::vector<std::uint32_t> indices;  ///< triangles
};

/// What meshes of the same cards share whatever light is on them.
struct CardColumns {
  Attributes attributes;
  int indices = -1;
};

/// Adds all but the colours; with _OPTICAL_DEPTH, if a card is denser than its alpha tells.
CardColumns addCardColumns(GlbFile& file, const CardMesh& mesh);

/// Adds the colours and the mesh.
int addCardMesh(GlbFile& file, const std::string& name, const CardColumns& columns, const CardMesh& mesh,
                int material);

}  // namespace cloudgen::writer::gltf
