// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace cloudgen::image {

/// From display-linear radiance to the display (sRGB): as it is up to 0.75, above that rolled off towards 1,
/// so that the glare about the sun has no hard edge and keeps its hue.
glm::vec3 displayed(const glm::vec3& radiance);

}  // namespace cloudgen::image
