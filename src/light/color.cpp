// SPDX-License-Identifier: Apache-2.0
#include "light/color.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::light {

glm::vec3 srgbFromLinear(glm::vec3 linear) {
  for (int c = 0; c < 3; ++c) {
    const float v = std::clamp(linear[c], 0.0f, 1.0f);
    linear[c] = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
  }
  return linear;
}

glm::vec3 linearFromSrgb(glm::vec3 encoded) {
  for (int c = 0; c < 3; ++c) {
    const float v = std::clamp(encoded[c], 0.0f, 1.0f);
    encoded[c] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  }
  return encoded;
}

}  // namespace cloudgen::light
