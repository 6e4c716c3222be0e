// SPDX-License-Identifier: Apache-2.0
#include "image/tone.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "light/color.hpp"

namespace cloudgen::image {
namespace {

float rolledOff(float value) {
  constexpr float kKnee = 0.75f, kRoom = 1.0f - kKnee;
  const float over = (value - kKnee) / kRoom;
  return over > 0 ? kKnee + kRoom * over / (1 + over) : value;
}

}  // namespace

glm::vec3 displayed(const glm::vec3& radiance) {
  const float most = std::max({radiance.x, radiance.y, radiance.z, 1e-6f});
  const glm::vec3 sameHue = radiance * (rolledOff(most) / most);
  const glm::vec3 each(rolledOff(radiance.x), rolledOff(radiance.y), rolledOff(radiance.z));
  return light::srgbFromLinear(glm::mix(each, sameHue, 0.6f));
}

}  // namespace cloudgen::image
