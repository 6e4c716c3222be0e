// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "writer/tiles3d/merging.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

constexpr int kDeepest = 20;
constexpr double kLeastSideMeters = 1000, kErrorGrowth = 1.5, kMostGrowth = 3;
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

/// Puts coarser tiles of the same ground between tiles and their parents, and above the root.
class Stepper {
 public:
  Stepper(const scene::Scene& scene, TileTree tree, double mostErrorMeters)
      : scene_(scene), from_(std::move(tree)), mostError_(mostErrorMeters) {}

  TileTree stepped() {
    to_.order = from_.order;
    if (!from_.nodes.empty()) addRoot();
    return std::move(to_);
  }

 private:
  void addRoot() {
    const double most = std::min(rootError(), mostError_), own = shownError(from_.nodes[0]);
    const int steps = stepsBetween(most, own);
    add(0, most, own, steps, steps);
  }

  /// Adds a square, before it `coarser` coarser ones with errors that rise evenly to `most` in `steps`.
  std::uint32_t add(std::uint32_t from, double most, double own, int steps, int coarser) {
    const auto index = static_cast<std::uint32_t>(to_.nodes.size());
    TileNode node = from_.nodes[from];
    to_.nodes.push_back(node);
    node.coarser = coarser;
    if (coarser > 0) {
      const double error = own * std::pow(most / own, static_cast<double>(coarser) / steps);
      node.detail = {error, node.detail.cellMeters > 0 ? error / kVisibleSigmas : 0};
      node.children = {add(from, most, own, steps, coarser - 1)};
    } else {
      for (std::uint32_t& child : node.children) child = addChild(child, node.detail.errorMeters);
    }
    to_.nodes[index] = std::move(node);
    return index;
  }

  std::uint32_t addChild(std::uint32_t from, double parentError) {
    const double most = std::min(parentError, mostError_), own = shownError(from_.nodes[from]);
    const int steps = stepsBetween(most, own);
    // The last step is the parent, if that is not left out as too coarse.
    const bool isParent = most == parentError;
    return add(from, most, own, steps, std::max(0, isParent ? steps - 1 : steps));
  }

  static int stepsBetween(double most, double own) {
    return most > kErrorGrowth * own ? static_cast<int>(std::ceil(std::log(most / own) / std::log(kMostGrowth))) : 0;
  }

  /// As coarse as this a tile looks. In a leaf: as that of which nine tenths of what it draws would not be merged.
  double shownError(const TileNode& node) const {
    if (!node.isLeaf()) return node.detail.errorMeters;
    std::vector<std::pair<float, double>> squares;  // deviation, its square
    double all = 0;
    for (const LitPuff& lit : puffsAt(scene_, from_.cloudsOf(node), {})) {
      const float sigma = std::max({lit.puff.sigma.x, lit.puff.sigma.y, lit.puff.sigma.z});
      squares.emplace_back(sigma, double{sigma} * double{sigma});
      all += squares.back().second;
    }
    std::sort(squares.begin(), squares.end());
    double sum = 0;
    for (const auto& [sigma, square] : squares)
      if ((sum += square) >= 0.1 * all) return std::max(kLeastErrorMeters, double{sigma} / kLeastSigmaOfError);
    return kLeastErrorMeters;
  }

  /// Where the sky is so many errors wide, and no cloud is more than one puff.
  double rootError() const {
    constexpr double kErrorsAcross = 16;
    glm::vec3 lower(1e30f), upper(-1e30f);
    double error = 0;
    for (const scene::Instance& instance : scene_.instances) {
      lower = glm::min(lower, instance.position), upper = glm::max(upper, instance.position);
      const glm::vec3& sigma = scene_.archetypes[scene_.lit[instance.lit].archetype].onePuff.sigma;
      error = std::max(error, 2 * kVisibleSigmas * static_cast<double>(instance.scale * std::max({sigma.x, sigma.y, sigma.z})));
    }
    return std::max(error, static_cast<double>(std::max(upper.x - lower.x, upper.z - lower.z)) / kErrorsAcross);
  }

  const scene::Scene& scene_;
  TileTree from_, to_;
  double mostError_;
};

}  // namespace

std::string TileNode::name() const {
  return fmt::format("{}_{}_{}", level, column, row) + (coarser > 0 ? fmt::format("_c{}", coarser) : "");
}

TileTree tileTree(const scene::Scene& scene, std::size_t mostPuffs, double mostErrorMeters) {
  return Stepper(scene, Grower(scene, mostPuffs).grow(), mostErrorMeters).stepped();
}

}  // namespace cloudgen::writer::tiles3d
