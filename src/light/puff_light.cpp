// SPDX-License-Identifier: Apache-2.0
#include "light/puff_light.hpp"

#include "light/color.hpp"

namespace cloudgen::light {

EncodedLight encoded(const PuffLight& light, const glm::vec3& sunColor) {
  const glm::vec3 base = srgbFromLinear(light.color);
  const glm::vec3 lining = srgbFromLinear(light.color + light.forward * sunColor) - base;
  return {base + 0.25f * lining, 0.5f * lining};
}

}  // namespace cloudgen::light
