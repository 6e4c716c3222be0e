// SPDX-License-Identifier: Apache-2.0
#include "shape/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace cloudgen::shape {
namespace {

struct Moments {
  double mass = 0;
  glm::dvec3 mean{0}, variance{0};
};

/// Diagonal of a rotated Gaussian's covariance.
glm::dvec3 ownVariance(const Puff& puff) {
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  glm::dvec3 variance(0);
  for (int i = 0; i < 3; ++i)
    variance += glm::dvec3(axes[i] * axes[i]) * static_cast<double>(puff.sigma[i] * puff.sigma[i]);
  return variance;
}

Moments momentsOf(std::span<const Puff> puffs) {
  Moments moments;
  for (const Puff& puff : puffs) {
    const double mass = extinctionArea(puff);
    moments.mass += mass;
    moments.mean += mass * glm::dvec3(puff.center);
  }
  if (moments.mass <= 0) return moments;
  moments.mean /= moments.mass;
  for (const Puff& puff : puffs) {
    const glm::dvec3 away = glm::dvec3(puff.center) - moments.mean;
    moments.variance += extinctionArea(puff) / moments.mass * (ownVariance(puff) + away * away);
  }
  return moments;
}

Puff merged(std::span<const Puff> puffs) {
  const Moments moments = momentsOf(puffs);
  Puff puff = puffs[puffs.size() / 2];
  if (moments.mass <= 0) return puff;
  puff.center = moments.mean;
  puff.rotation = glm::quat(1, 0, 0, 0);
  puff.sigma = glm::max(glm::sqrt(moments.variance), glm::dvec3(1e-3));
  const double unit = std::pow(2.0 * std::numbers::pi, 1.5) * puff.sigma.x * puff.sigma.y * puff.sigma.z;
  puff.extinctionPerMeter = static_cast<float>(moments.mass / unit);
  return puff;
}

void split(std::span<Puff> puffs, int count, std::vector<Puff>& out) {
  if (puffs.empty()) return;
  if (count <= 1 || puffs.size() == 1) {
    out.push_back(merged(puffs));
    return;
  }
  const glm::dvec3 variance = momentsOf(puffs).variance;
  const int axis =
      variance.x >= variance.y && variance.x >= variance.z ? 0 : (variance.y >= variance.z ? 1 : 2);
  std::stable_sort(puffs.begin(), puffs.end(),
                   [axis](const Puff& a, const Puff& b) { return a.center[axis] < b.center[axis]; });
  const size_t middle = puffs.size() / 2;
  split(puffs.first(middle), count / 2, out);
  split(puffs.subspan(middle), count - count / 2, out);
}

}  // namespace

std::vector<Puff> reduce(std::span<const Puff> puffs, int count) {
  std::vector<Puff> sorted(puffs.begin(), puffs.end()), out;
  split(sorted, count, out);
  return out;
}

}  // namespace cloudgen::shape
