// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::shape {

float blendedWidening(float opticalDepth, float covering) {
  const auto reachOf = [](float ratio) { return std::sqrt(2 * std::log(std::max(ratio, 1.0f))); };
  const float wanted = reachOf(opticalDepth / covering);
  float widening = 1;
  for (int pass = 0; pass < 4; ++pass) {
    const float opacity = -std::expm1(-opticalDepth / (widening * widening));
    const float reach = reachOf(opacity / -std::expm1(-covering));
    if (!(reach > 0.5f)) break;  // so thin that all of it is about to go under
    widening = std::clamp(wanted / reach, 1.0f, 2.0f);
  }
  return widening;
}

Puff widenedAcross(Puff puff) {
  constexpr float kCovering = 0.015f;  // many overlap
  const float by = blendedWidening(frontalOpticalDepth(puff), kCovering);
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  for (int i = 0; i < 3; ++i) {
    const float along = glm::mix(by, 1.0f, axes[i].y * axes[i].y);
    puff.sigma[i] *= along;
    puff.extinctionPerMeter /= along;
  }
  return puff;
}

}  // namespace cloudgen::shape
