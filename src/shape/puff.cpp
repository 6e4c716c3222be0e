// SPDX-License-Identifier: Apache-2.0
#include "shape/puff.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace cloudgen::shape {

float centralOpticalDepth(float extinctionPerMeter, float sigma) {
  return extinctionPerMeter * sigma * static_cast<float>(std::sqrt(2.0 * std::numbers::pi));
}

float frontalOpticalDepth(const Puff& puff) {
  return centralOpticalDepth(puff.extinctionPerMeter, std::min({puff.sigma.x, puff.sigma.y, puff.sigma.z}));
}

double extinctionArea(const Puff& puff) {
  const double twoPi = 2.0 * std::numbers::pi;
  return puff.extinctionPerMeter * twoPi * std::sqrt(twoPi) * puff.sigma.x * puff.sigma.y * puff.sigma.z;
}

double heightDeviation(const Puff& puff) {
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  double variance = 0;
  for (int k = 0; k < 3; ++k) variance += std::pow(static_cast<double>(puff.sigma[k]) * axes[k].y, 2);
  return std::sqrt(variance);
}

Bounds boundsOf(std::span<const Puff> puffs, float reach) {
  if (puffs.empty()) return {};
  Bounds bounds{glm::vec3(1e30f), glm::vec3(-1e30f)};
  for (const Puff& puff : puffs) {
    // Half-width of a rotated Gaussian along each world axis: the root of the diagonal of its covariance.
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    glm::vec3 half(0);
    for (int i = 0; i < 3; ++i) half += axes[i] * axes[i] * (puff.sigma[i] * puff.sigma[i]);
    half = reach * glm::sqrt(half);
    bounds.lower = glm::min(bounds.lower, puff.center - half);
    bounds.upper = glm::max(bounds.upper, puff.center + half);
  }
  return bounds;
}

}  // namespace cloudgen::shape
