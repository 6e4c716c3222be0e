// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

namespace cloudgen::light {

/// The sRGB code values (IEC 61966-2-1) of a display-linear colour, both 0..1; what lies outside is clamped.
inline glm::vec3 srgbFromLinear(const glm::vec3& linear) {
  const glm::vec3 value = glm::clamp(linear, glm::vec3(0), glm::vec3(1));
  const glm::vec3 curve = 1.055f * glm::pow(value, glm::vec3(1.0f / 2.4f)) - 0.055f;
  return glm::mix(curve, 12.92f * value, glm::lessThanEqual(value, glm::vec3(0.0031308f)));
}

}  // namespace cloudgen::light
