// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace cloudgen::light {

/// The sRGB transfer curve (IEC 61966-2-1), each channel clamped to 0..1 first.
glm::vec3 srgbFromLinear(glm::vec3 linear);
glm::vec3 linearFromSrgb(glm::vec3 encoded);

}  // namespace cloudgen::light
