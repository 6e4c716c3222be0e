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

std::vector<Puff> divided(std::span<const Puff> puffs, float most) {
  constexpr float kSpread = 0.6f;  // of the parts, as a share of the whole's deviation
  const float kNarrowed = std::sqrt(1 - kSpread * kSpread);
  std::vector<Puff> out;
  for (const Puff& puff : puffs) {
    const float depth = frontalOpticalDepth(puff);
    if (!(depth > most)) {
      out.push_back(puff);
      continue;
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (puff.sigma[i] > puff.sigma[axis]) axis = i;
    const int parts =
        static_cast<int>(std::min(1000.0f, std::max(2.0f, std::ceil(depth / (kNarrowed * most)))));
    glm::vec3 along(0);
    along[axis] = puff.sigma[axis];
    along = puff.rotation * along;
    // Evenly spaced parts whose variance is that of the spread.
    const auto count = static_cast<float>(parts);
    const float step = kSpread * std::sqrt(12.0f / (count * count - 1));
    for (int i = 0; i < parts; ++i) {
      Puff part = puff;
      part.center += along * step * (static_cast<float>(i) - 0.5f * (count - 1));
      part.sigma[axis] *= kNarrowed;
      part.extinctionPerMeter /= kNarrowed * count;
      out.push_back(part);
    }
  }
  return out;
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
