// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "writer/tiles3d/detail.hpp"

namespace cloudgen::writer::tiles3d {

/// The most puffs that a tile draws as splats, and as cards, but for single clouds of more.
inline constexpr std::size_t kMostPuffsOfTile = 40'000, kMostPuffsOfCardTile = 10'000;

/// A square of the quadtree over the ground of the scene frame; it holds the clouds whose origin stands in it.
struct TileNode {
  int level = 0, column = 0, row = 0;   ///< counted from the west and the north
  int coarser = 0;                      ///< 0: the square itself; else how often coarser than it, over the same ground
  std::size_t first = 0, count = 0;     ///< its clouds in TileTree::order
  std::vector<std::uint32_t> children;  ///< indices of nodes; they come after their parent
  Detail detail;

  bool isLeaf() const { return children.empty(); }
  std::string name() const;  ///< "2_1_3": level, column, row; "2_1_3_c1": once coarser
};

struct TileTree {
  std::vector<std::uint32_t> order;  ///< the scene's instances, each tile's side by side
  std::vector<TileNode> nodes;       ///< the root first; none without clouds

  Clouds cloudsOf(const TileNode& node) const { return Clouds(order).subspan(node.first, node.count); }
};

/// Squares are divided until their clouds have at most `mostPuffs` puffs and they are at most 1000 km wide. Leaves
/// draw all of them, other tiles as many as the most allow; the error of a parent is at least half more than those
/// of its children. Where it is more than three times that, the same square stands between in steps, and above the
/// root until all of the sky is some 16 errors wide, with errors of at most `mostErrorMeters`: so viewers always draw
/// puffs that are several pixels wide, however far off.
TileTree tileTree(const scene::Scene& scene, std::size_t mostPuffs = kMostPuffsOfTile, double mostErrorMeters = 1e9);

}  // namespace cloudgen::writer::tiles3d
