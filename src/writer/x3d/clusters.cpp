// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/clusters.hpp"

#include <glm/common.hpp>
#include <numeric>

namespace cloudgen::writer {
namespace {

using shape::Puff;

constexpr float kRound = 1.7f;       ///< longest to shortest side of a part that may turn as it is
constexpr float kStillTurns = 2.2f;  ///< the same when there is no room for more clusters
constexpr float kLongPuff = 2.0f;  ///< longest to shortest deviation of puffs that must keep their direction

struct Part {
  Cluster cluster;
  glm::vec3 size{0};
  bool longPuffs = false;

  float elongation() const {
    return std::max({size.x, size.y, size.z}) / std::max(std::min({size.x, size.y, size.z}), 1e-3f);
  }
  bool canSplit() const { return !longPuffs && cluster.puffs.size() > 1 && elongation() > kRound; }
};

Part partOf(std::span<const Puff> puffs, std::vector<std::uint32_t> members) {
  Part part;
  std::vector<Puff> own;
  double stretch = 0;
  for (const std::uint32_t i : members) {
    own.push_back(puffs[i]);
    const glm::vec3& s = puffs[i].sigma;
    stretch += std::log(std::max({s.x, s.y, s.z}) / std::min({s.x, s.y, s.z}));
  }
  const shape::Bounds box = shape::boundsOf(own, 1.5f);
  part.longPuffs = stretch / static_cast<double>(members.size()) > std::log(kLongPuff);
  part.size = box.upper - box.lower;
  part.cluster.center = 0.5f * (box.lower + box.upper);
  part.cluster.puffs = std::move(members);
  return part;
}

/// Cuts a part at the mean of its centres across the longest side; the halves are never empty.
std::pair<Part, Part> halves(std::span<const Puff> puffs, const Part& part) {
  const glm::vec3& size = part.size;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.z >= size.y ? 2 : 1;
  std::vector<std::uint32_t> order = part.cluster.puffs;
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return puffs[a].center[axis] < puffs[b].center[axis]; });
  double mean = 0;
  for (const std::uint32_t i : order) mean += puffs[i].center[axis];
  mean /= static_cast<double>(order.size());
  const auto above =
      std::find_if(order.begin(), order.end(), [&](auto i) { return puffs[i].center[axis] >= mean; });
  const auto cut = std::clamp<std::ptrdiff_t>(above - order.begin(), 1, std::ssize(order) - 1);
  std::vector<std::uint32_t> low(order.begin(), order.begin() + cut), high(order.begin() + cut, order.end());
  std::sort(low.begin(), low.end());
  std::sort(high.begin(), high.end());
  return {partOf(puffs, std::move(low)), partOf(puffs, std::move(high))};
}

}  // namespace

std::vector<Cluster> clustersOf(std::span<const Puff> puffs, std::span<const std::uint32_t> sectionStart,
                                std::size_t most) {
  if (puffs.empty()) return {};
  std::vector<Part> parts;
  if (sectionStart.size() >= 2 && sectionStart.size() - 1 <= most) {
    for (size_t s = 0; s + 1 < sectionStart.size(); ++s) {
      if (sectionStart[s] == sectionStart[s + 1]) continue;
      std::vector<std::uint32_t> members(sectionStart[s + 1] - sectionStart[s]);
      std::iota(members.begin(), members.end(), sectionStart[s]);
      parts.push_back(partOf(puffs, std::move(members)));
    }
  }
  if (parts.empty()) {
    std::vector<std::uint32_t> all(puffs.size());
    std::iota(all.begin(), all.end(), 0u);
    parts.push_back(partOf(puffs, std::move(all)));
  }
  while (parts.size() < most) {
    const auto worst = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      return (a.canSplit() ? a.elongation() : 0) < (b.canSplit() ? b.elongation() : 0);
    });
    if (!worst->canSplit()) break;
    auto [low, high] = halves(puffs, *worst);
    *worst = std::move(low);
    parts.push_back(std::move(high));
  }
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> flat;
  for (Part& part : parts) {
    if (!part.longPuffs && part.elongation() <= kStillTurns)
      clusters.push_back(std::move(part.cluster));
    else
      flat.insert(flat.end(), part.cluster.puffs.begin(), part.cluster.puffs.end());
  }
  if (!flat.empty()) {
    std::sort(flat.begin(), flat.end());
    clusters.push_back(partOf(puffs, std::move(flat)).cluster);
    clusters.back().turns = false;
  }
  return clusters;
}

}  // namespace cloudgen::writer
