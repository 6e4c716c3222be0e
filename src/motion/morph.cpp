// SPDX-License-Identifier: Apache-2.0
#include "motion/morph.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/thread.hpp"

namespace cloudgen::motion {
namespace {

constexpr std::size_t kNearest = 16;  ///< puffs that are looked at as partners of one
constexpr int kPasses = 4;

/// Centres in a box of side 1.
std::vector<glm::vec3> normalised(std::span<const shape::Puff> puffs) {
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const shape::Puff& puff : puffs) lower = glm::min(lower, puff.center), upper = glm::max(upper, puff.center);
  const glm::vec3 size = glm::max(upper - lower, glm::vec3(1e-6f));
  std::vector<glm::vec3> out;
  for (const shape::Puff& puff : puffs) out.push_back((puff.center - lower) / size);
  return out;
}

float squared(const glm::vec3& a, const glm::vec3& b) { return glm::dot(a - b, a - b); }

/// For each place the nearest of the others, nearest first.
std::vector<std::vector<std::uint32_t>> nearestOf(const std::vector<glm::vec3>& places, const std::vector<glm::vec3>& others) {
  std::vector<std::vector<std::uint32_t>> nearest(places.size());
  base::parallelFor(places.size(), [&](std::size_t i) {
    std::vector<std::uint32_t> order(others.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::size_t count = std::min(kNearest, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                        return std::pair(squared(places[i], others[a]), a) < std::pair(squared(places[i], others[b]), b);
                      });
    order.resize(count);
    nearest[i] = std::move(order);
  });
  return nearest;
}

/// One of `many` for each of `few`, no two the same.
std::vector<std::uint32_t> assigned(const std::vector<glm::vec3>& few, const std::vector<glm::vec3>& many) {
  const auto nearest = nearestOf(few, many);
  std::vector<std::pair<float, std::pair<std::uint32_t, std::uint32_t>>> pairs;
  for (std::uint32_t i = 0; i < few.size(); ++i)
    for (const std::uint32_t k : nearest[i]) pairs.push_back({squared(few[i], many[k]), {i, k}});
  std::sort(pairs.begin(), pairs.end());
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> partner(few.size(), kNone), owner(many.size(), kNone);
  for (const auto& [distance, pair] : pairs)
    if (partner[pair.first] == kNone && owner[pair.second] == kNone) partner[pair.first] = pair.second, owner[pair.second] = pair.first;
  for (std::uint32_t i = 0; i < few.size(); ++i) {
    if (partner[i] != kNone) continue;
    std::uint32_t best = kNone;
    for (std::uint32_t k = 0; k < many.size(); ++k)
      if (owner[k] == kNone && (best == kNone || squared(few[i], many[k]) < squared(few[i], many[best]))) best = k;
    partner[i] = best, owner[best] = i;
  }
  for (int pass = 0; pass < kPasses; ++pass)
    for (std::uint32_t i = 0; i < few.size(); ++i)
      for (const std::uint32_t k : nearest[i]) {
        const std::uint32_t other = owner[k];
        if (other == i) continue;
        const float now = squared(few[i], many[partner[i]]) + (other == kNone ? 0 : squared(few[other], many[k])),
                    then = squared(few[i], many[k]) + (other == kNone ? 0 : squared(few[other], many[partner[i]]));
        if (!(then < now)) continue;
        owner[partner[i]] = other;
        if (other != kNone) partner[other] = partner[i];
        partner[i] = k, owner[k] = i;
      }
  return partner;
}

}  // namespace

std::vector<PuffPair> matchPuffs(std::span<const shape::Puff> from, std::span<const shape::Puff> to) {
  if (from.empty() || to.empty()) return {};
  const bool grows = from.size() <= to.size();
  const auto few = normalised(grows ? from : to), many = normalised(grows ? to : from);
  const std::vector<std::uint32_t> partner = assigned(few, many);
  std::vector<std::uint32_t> ofMany(many.size(), ~0u), shares(few.size(), 1);
  for (std::uint32_t i = 0; i < few.size(); ++i) ofMany[partner[i]] = i;
  for (std::uint32_t k = 0; k < many.size(); ++k) {
    if (ofMany[k] != ~0u) continue;
    ofMany[k] = static_cast<std::uint32_t>(
        std::min_element(few.begin(), few.end(),
                         [&](const glm::vec3& a, const glm::vec3& b) { return squared(a, many[k]) < squared(b, many[k]); }) -
        few.begin());
    ++shares[ofMany[k]];
  }
  std::vector<PuffPair> pairs;
  for (std::uint32_t k = 0; k < many.size(); ++k) {
    const float share = 1 / static_cast<float>(shares[ofMany[k]]);
    pairs.push_back(grows ? PuffPair{ofMany[k], k, share, 1} : PuffPair{k, ofMany[k], 1, share});
  }
  return pairs;
}

std::vector<shape::Puff> morphed(std::span<const shape::Puff> from, std::span<const shape::Puff> to,
                                 std::span<const PuffPair> pairs, float share) {
  std::vector<shape::Puff> puffs;
  puffs.reserve(pairs.size());
  for (const PuffPair& pair : pairs) {
    const shape::Puff &a = from[pair.from], &b = to[pair.to];
    shape::Puff puff = share < 0.5f ? a : b;
    puff.center = glm::mix(a.center, b.center, share);
    puff.sigma = glm::mix(a.sigma, b.sigma, share);
    puff.rotation = glm::slerp(a.rotation, b.rotation, share);
    puff.extinctionPerMeter = 1;
    const double mass = (1 - share) * pair.fromShare * shape::extinctionArea(a) + share * pair.toShare * shape::extinctionArea(b);
    puff.extinctionPerMeter = static_cast<float>(mass / shape::extinctionArea(puff));
    puffs.push_back(puff);
  }
  return puffs;
}

}  // namespace cloudgen::motion
