// SPDX-License-Identifier: Apache-2.0
#include "shape/heights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cloudgen::shape {
namespace {

/// A puff's extinction over height: a normal distribution.
struct Upright {
  double mean, deviation, weight;
};

bool fallsOut(const Puff& puff) { return puff.center.y < 0; }

bool isLeaning(const Puff& puff) {
  return std::abs(puff.rotation.x) > 1e-4f || std::abs(puff.rotation.z) > 1e-4f;
}

/// What is left beyond base and top would be seen as cloud there, however little it is, where the cloud is
/// dense: puffs near them are flatter; of many they are smaller, too, or they would lie there as discs.
void flattenTowardsEnds(std::span<Puff> puffs, float depthMeters) {
  constexpr float kBeyond = 0.03f, kDeviations = 2.5f, kFlattest = 0.25f;
  constexpr std::size_t kMany = 150;
  for (Puff& puff : puffs) {
    if (fallsOut(puff) || isLeaning(puff)) continue;
    puff.center.y = std::min(puff.center.y, depthMeters - 0.3f * puff.sigma.y);
    const float room = std::min(puff.center.y, depthMeters - puff.center.y) + kBeyond * depthMeters;
    const float flatter = std::clamp(room / (kDeviations * puff.sigma.y), kFlattest, 1.0f);
    const float narrower = puffs.size() > kMany ? std::sqrt(flatter) : 1.0f;
    puff.sigma *= glm::vec3(narrower, flatter, narrower);
    puff.extinctionPerMeter /= flatter * narrower * narrower;
  }
}

std::vector<Upright> uprights(std::span<const Puff> puffs, bool withPrecipitation) {
  std::vector<Upright> out;
  double whole = 0;
  for (const Puff& puff : puffs) {
    if (!withPrecipitation && fallsOut(puff)) continue;
    out.push_back({puff.center.y, heightDeviation(puff), extinctionArea(puff)});
    whole += out.back().weight;
  }
  for (Upright& puff : out) puff.weight /= whole;
  return out;
}

double heightOfShare(const std::vector<Upright>& puffs, double share) {
  double low = 1e30, high = -1e30;
  for (const Upright& puff : puffs) {
    low = std::min(low, puff.mean - 4 * puff.deviation);
    high = std::max(high, puff.mean + 4 * puff.deviation);
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    double below = 0;
    for (const Upright& puff : puffs)
      below += puff.weight * 0.5 *
               std::erfc((puff.mean - middle) / (std::max(puff.deviation, 1e-6) * std::numbers::sqrt2));
    (below < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double heightOfShare(std::span<const Puff> puffs, double share) {
  return puffs.empty() ? 0 : heightOfShare(uprights(puffs, true), share);
}

void spreadBetween(std::span<Puff> puffs, double borderShare, double depthMeters, Ends ends) {
  if (puffs.empty()) return;
  // Puffs that lean keep their deviations, or they would no longer be ellipsoids of the same axes: what this
  // leaves over, further passes mend.
  for (int pass = 0; pass < 5; ++pass) {
    const std::vector<Upright> heights = uprights(puffs, false);
    if (heights.empty()) return;
    const double lower = heightOfShare(heights, borderShare), upper = heightOfShare(heights, 1 - borderShare);
    const double stretch =
        std::clamp((1 - 2 * borderShare) * depthMeters / std::max(upper - lower, 1e-3), 0.2, 5.0);
    for (Puff& puff : puffs) {
      if (fallsOut(puff)) continue;
      puff.center.y =
          std::max(0.0f, static_cast<float>(borderShare * depthMeters + (puff.center.y - lower) * stretch));
      if (isLeaning(puff)) continue;
      puff.sigma.y = static_cast<float>(puff.sigma.y * stretch);
      puff.extinctionPerMeter = static_cast<float>(puff.extinctionPerMeter / stretch);
    }
    if (ends == Ends::Flat) flattenTowardsEnds(puffs, static_cast<float>(depthMeters));
  }
  // No centre so high that most of its puff would stand above the top.
  constexpr double kOvershoot = 1.09;
  const auto most = static_cast<float>(depthMeters * (ends == Ends::Overshooting ? kOvershoot : 1));
  for (Puff& puff : puffs) puff.center.y = std::min(puff.center.y, most - 0.3f * puff.sigma.y);
}

void gatherAt(std::span<Puff> puffs, double middle, double borderShare) {
  constexpr double kMost = 4;
  const std::vector<Upright> heights = uprights(puffs, false);
  if (heights.empty()) return;
  const double lower = heightOfShare(heights, borderShare),
               depth = heightOfShare(heights, 1 - borderShare) - lower;
  if (!(depth > 0)) return;
  // The projective map of the interval onto itself that takes the one middle to the other.
  const double now = std::clamp((heightOfShare(heights, 0.5) - lower) / depth, 0.1, 0.9);
  const double bend = std::clamp(now * (1 - middle) / (middle * (1 - now)), 1 / kMost, kMost);
  for (Puff& puff : puffs) {
    const double at = (puff.center.y - lower) / depth;
    if (fallsOut(puff) || at <= 0 || at >= 1) continue;
    const double whole = at + bend * (1 - at);
    puff.center.y = std::max(0.0f, static_cast<float>(lower + depth * at / whole));
    if (isLeaning(puff)) continue;
    const auto stretch = static_cast<float>(bend / (whole * whole));
    puff.sigma.y *= stretch, puff.extinctionPerMeter /= stretch;
  }
}

void standOverCentroid(std::span<Puff> puffs) {
  glm::dvec3 sum(0);
  double whole = 0;
  for (const Puff& puff : puffs) {
    const double weight = extinctionArea(puff);
    sum += weight * glm::dvec3(puff.center);
    whole += weight;
  }
  if (!(whole > 0)) return;
  const glm::vec3 aside(sum.x / whole, 0, sum.z / whole);
  for (Puff& puff : puffs) puff.center -= aside;
}

}  // namespace cloudgen::shape
