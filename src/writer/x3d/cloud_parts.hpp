// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// Quads of a cloud that are drawn as one Shape, in the cloud's own metres.
struct CloudPart {
  bool turns = false;   ///< true: a Billboard about `center`, which the quads are given from
  glm::vec3 center{0};  ///< zero for those that stay where they are
  QuadMesh mesh;
};

/// A lit archetype as it is seen from near, turned by its yaw; `sunlight` is the share of the sun that other
/// clouds leave it.
std::vector<CloudPart> fullParts(const scene::Scene& scene, std::uint32_t lit, float sunlight,
                                 const image::SpriteAtlas& atlas);
/// The same as its far puffs in one part.
std::vector<CloudPart> simpleParts(const scene::Scene& scene, std::uint32_t lit, float sunlight,
                                   const image::SpriteAtlas& atlas);

}  // namespace cloudgen::writer
