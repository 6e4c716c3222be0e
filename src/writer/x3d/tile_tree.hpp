// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "scene/scene.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// A square of the ground with the clouds that stand on it; one with many clouds has squares within.
struct TileNode {
  std::string name;                      ///< "2_0", and "2_0_3" of one within it: part of a DEF
  float side = 0;                        ///< metres
  glm::vec3 lower{0}, upper{0};          ///< box around the clouds
  std::vector<std::uint32_t> instances;  ///< ascending
  std::vector<TileNode> children;        ///< those with clouds

  glm::vec3 middle() const { return 0.5f * (lower + upper); }
};

/// How long it takes to read instances in full from one file, in puffs: clouds share their archetype there.
std::size_t puffsToRead(const scene::Scene& scene, std::span<const std::uint32_t> instances);

/// Squares of tileSide, or a half, a quarter .. of it where they would have more puffs than viewers read at a
/// time. Each is divided until few clouds stand on one, or it is hardly wider than they are.
std::vector<TileNode> tileTrees(const scene::Scene& scene, const Stage& stage);

}  // namespace cloudgen::writer
