// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>

namespace cloudgen::writer::tiles3d {
namespace {

constexpr int kDeepest = 20;
constexpr double kLeastSideMeters = 1000, kErrorGrowth = 1.5;
/// Places in a wider tile are rounded to more than a decimetre when they are packed, and in viewers.
constexpr double kWidestLeafMeters = 1e6;
/// Of tiles with children, whose puffs may be all there, but less precisely.
constexpr double kLeastErrorMeters = 1;

struct Square {
  double west = 0, north = 0, side = kLeastSideMeters;
};

class Grower {
 public:
  Grower(const scene::Scene& scene, std::size_t mostPuffs) : scene_(scene), mostPuffs_(mostPuffs) {}

  TileTree grow() {
    if (scene_.instances.empty()) return {};
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) tree_.order.push_back(i);
    glm::dvec3 lower(1e30), upper(-1e30);
    for (const scene::Instance& instance : scene_.instances) {
      lower = glm::min(lower, glm::dvec3(instance.position));
      upper = glm::max(upper, glm::dvec3(instance.position));
    }
    const double side = std::max({upper.x - lower.x, upper.z - lower.z, kLeastSideMeters});
    TileNode root;
    root.count = tree_.order.size();
    add(std::move(root), {lower.x, lower.z, side});
    return std::move(tree_);
  }

 private:
  std::uint32_t add(TileNode node, const Square& square) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.push_back(node);
    const bool tooMuch = square.side > kWidestLeafMeters || drawnPuffs(node) > mostPuffs_;
    if (tooMuch && node.count > 1 && node.level < kDeepest)
      node.children = divide(node, square);
    double error = kLeastErrorMeters;
    for (const std::uint32_t child : node.children)
      error = std::max(error, kErrorGrowth * tree_.nodes[child].detail.errorMeters);
    if (!node.isLeaf()) node.detail = detailWithin(scene_, tree_.cloudsOf(node), mostPuffs_, error);
    tree_.nodes[index] = std::move(node);
    return index;
  }

  std::size_t drawnPuffs(const TileNode& node) const {
    std::size_t puffs = 0;
    for (const std::uint32_t cloud : tree_.cloudsOf(node))
      puffs += scene_.lit[scene_.instances[cloud].lit].puffs.size();
    return puffs;
  }

  /// Sorts the clouds of the tile by quarter and grows a child in each that has some.
  std::vector<std::uint32_t> divide(const TileNode& node, const Square& square) {
    const double half = 0.5 * square.side, middleX = square.west + half, middleZ = square.north + half;
    const auto quarterOf = [&](std::uint32_t cloud) {
      const glm::vec3& place = scene_.instances[cloud].position;
      return (place.z >= middleZ ? 2 : 0) + (place.x >= middleX ? 1 : 0);
    };
    const auto begin = tree_.order.begin() + static_cast<std::ptrdiff_t>(node.first),
               end = begin + static_cast<std::ptrdiff_t>(node.count);
    std::stable_sort(begin, end,
                     [&](std::uint32_t a, std::uint32_t b) { return quarterOf(a) < quarterOf(b); });
    std::array<std::size_t, 4> counts{};
    for (auto at = begin; at != end; ++at) ++counts[static_cast<std::size_t>(quarterOf(*at))];
    std::vector<std::uint32_t> children;
    for (std::size_t quarter = 0, first = node.first; quarter < 4; first += counts[quarter++]) {
      if (counts[quarter] == 0) continue;
      const int east = static_cast<int>(quarter % 2), south = static_cast<int>(quarter / 2);
      TileNode child;
      child.level = node.level + 1;
      child.column = 2 * node.column + east;
      child.row = 2 * node.row + south;
      child.first = first;
      child.count = counts[quarter];
      children.push_back(add(std::move(child), {square.west + east * half, square.north + south * half, half}));
    }
    return children;
  }

  const scene::Scene& scene_;
  std::size_t mostPuffs_;
  TileTree tree_;
};

}  // namespace

std::string TileNode::name() const { return fmt::format("{}_{}_{}", level, column, row); }

TileTree tileTree(const scene::Scene& scene, std::size_t mostPuffs) {
  return Grower(scene, mostPuffs).grow();
}

}  // namespace cloudgen::writer::tiles3d
