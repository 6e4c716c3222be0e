// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// How much further than it is drawn a tile is loaded: it is there when the viewer comes near.
inline constexpr float kLoadAhead = 1.25f;

/// A square of the ground with the clouds that stand on it; one with many clouds has four squares within.
struct TileNode {
  std::string name;                      ///< "2_0", and "2_0_3" of one within it
  float range = 0;                       ///< a viewer who is nearer to the middle sees what is within, metres
  glm::vec3 lower{0}, upper{0};          ///< box around the clouds
  std::vector<std::uint32_t> instances;  ///< ascending
  std::vector<TileNode> children;        ///< those with clouds

  glm::vec3 middle() const { return 0.5f * (lower + upper); }
};

/// At most 4 by 4 squares over the scene, about: each is divided until few clouds stand on one, or it is
/// hardly wider than they are.
std::vector<TileNode> tileTrees(const scene::Scene& scene, const Stage& stage);

}  // namespace cloudgen::writer
