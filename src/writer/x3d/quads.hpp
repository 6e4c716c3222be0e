// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "image/sprite_atlas.hpp"
#include "shape/blending.hpp"
#include "shape/puff.hpp"

namespace cloudgen::writer {

/// A textured rectangle; its front looks along right x up.
struct Quad {
  glm::vec3 center{0}, right{0}, up{0};  ///< half-sides
  glm::vec4 textureBox{0};               ///< u0, v0, u1, v1
  glm::vec4 color{1};                    ///< sRGB code values and opacity, 0..1
  float opticalDepth = 0;                ///< of the centre; what the opacity is made of
  float widening = 1;                    ///< its deviations to those of its puff
};

/// Quads and the order in which their faces are drawn: 2 i for the front of quad i, 2 i + 1 for its back.
struct QuadMesh {
  std::vector<Quad> quads;
  std::vector<std::uint32_t> faces;
};

/// A puff to be drawn, with its light in display-linear RGB.
struct LitPuff {
  shape::Puff puff;
  glm::vec3 color{1};
  float covering = shape::kCoveringAmongMany;  ///< as a blended blob: shape::blendedWidening
};

/// One quad a puff, laid out for a Billboard with its origin at `origin`: seen along -Z, back to front, no
/// back faces.
QuadMesh facingQuads(const std::vector<LitPuff>& puffs, const glm::vec3& origin,
                     const image::SpriteAtlas& atlas);

/// Up to three crossed quads a puff, in the planes of its own axes, with both faces; a flat puff has just the
/// level one, as upright slivers would be seen as needles from above. Straight from above level ones hold together the
/// optical depth of their puff. Their faces are in order.
QuadMesh crossedQuads(const std::vector<LitPuff>& puffs, const glm::vec3& origin,
                      const image::SpriteAtlas& atlas);

enum class LevelFaces : unsigned char { First, Last };

/// Puts the faces into an order in which from every side the near ones come last, given that back faces are
/// not drawn; level ones before or after all upright ones.
void orderFaces(QuadMesh& mesh, LevelFaces level);

}  // namespace cloudgen::writer
