// SPDX-License-Identifier: Apache-2.0
#include "image/tone.hpp"

#include <cmath>

#include "light/color.hpp"

namespace cloudgen::image {

glm::vec3 displayed(const glm::vec3& radiance) {
  constexpr float kKnee = 0.75f, kRoom = 1.0f - kKnee;
  glm::vec3 color = radiance;
  for (int c = 0; c < 3; ++c)
    if (color[c] > kKnee) color[c] = kKnee + kRoom * (1.0f - std::exp((kKnee - color[c]) / kRoom));
  return light::srgbFromLinear(color);
}

}  // namespace cloudgen::image
