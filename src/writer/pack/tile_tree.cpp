// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/tile_tree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "writer/pack/quantise.hpp"

namespace cloudgen::writer::packed {
namespace {

constexpr std::uint32_t kMostInLeaf = 32, kMostChildren = 8;
/// Bases of middle and of high clouds, metres.
constexpr float kMiddle = 2500, kHigh = 6000;

int storeyOf(const scene::Instance& cloud) {
  return cloud.position.y < kMiddle ? 0 : cloud.position.y < kHigh ? 1 : 2;
}

struct Run {
  std::uint32_t first = 0, count = 0;
};

/// Cuts a run into so many parts of nearly equal count, each time across the longer side of the ground that it covers.
void cut(const Run& run, std::uint32_t pieces, const scene::Scene& scene, std::vector<std::uint32_t>& order,
         std::vector<Run>& parts) {
  if (pieces == 1) {
    parts.push_back(run);
    return;
  }
  const auto begin = order.begin() + run.first, end = begin + run.count;
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (auto at = begin; at != end; ++at) {
    lower = glm::min(lower, scene.instances[*at].position);
    upper = glm::max(upper, scene.instances[*at].position);
  }
  const int axis = upper.x - lower.x >= upper.z - lower.z ? 0 : 2;
  std::stable_sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
    return scene.instances[a].position[axis] < scene.instances[b].position[axis];
  });
  const std::uint32_t less = pieces / 2, count = static_cast<std::uint32_t>(
                                             static_cast<std::uint64_t>(run.count) * less / pieces);
  cut({run.first, count}, less, scene, order, parts);
  cut({run.first + count, run.count - count}, pieces - less, scene, order, parts);
}

/// What a run falls into, sorted: its storeys, else equal parts; nothing where it is small enough.
std::vector<Run> partsOf(const Run& run, const scene::Scene& scene, std::vector<std::uint32_t>& order) {
  const auto begin = order.begin() + run.first, end = begin + run.count;
  std::vector<Run> parts;
  const auto storeyAt = [&](std::uint32_t index) { return storeyOf(scene.instances[index]); };
  if (run.count > 0 && storeyAt(*begin) != storeyAt(*(end - 1))) {
    for (auto from = begin; from != end;) {
      const auto to = std::find_if(from, end, [&](std::uint32_t i) { return storeyAt(i) != storeyAt(*from); });
      parts.push_back({static_cast<std::uint32_t>(from - order.begin()), static_cast<std::uint32_t>(to - from)});
      from = to;
    }
  } else if (run.count > kMostInLeaf) {
    cut(run, std::min(kMostChildren, (run.count + kMostInLeaf - 1) / kMostInLeaf), scene, order, parts);
  }
  return parts;
}

}  // namespace

TileTree tileTreeOf(const scene::Scene& scene) {
  TileTree tree;
  tree.order.resize(scene.instances.size());
  std::iota(tree.order.begin(), tree.order.end(), 0u);
  std::stable_sort(tree.order.begin(), tree.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return storeyOf(scene.instances[a]) < storeyOf(scene.instances[b]);
  });

  // Level by level, so that the children of a tile follow each other.
  std::vector<Run> runs{{0, static_cast<std::uint32_t>(tree.order.size())}};
  for (std::size_t t = 0; t < runs.size(); ++t) {
    const Run run = runs[t];
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const shape::Bounds box = scene::boundsOf(scene, scene.instances[tree.order[i]]);
      lower = glm::min(lower, box.lower);
      upper = glm::max(upper, box.upper);
    }
    if (run.count == 0) lower = upper = glm::vec3(0);
    const auto parts = partsOf(run, scene, tree.order);
    tree.tiles.emplace_back(vec3(lower), vec3(upper), run.first, run.count,
                            static_cast<std::uint32_t>(parts.empty() ? 0 : runs.size()),
                            static_cast<std::uint32_t>(parts.size()));
    runs.insert(runs.end(), parts.begin(), parts.end());
  }
  return tree;
}

}  // namespace cloudgen::writer::packed
