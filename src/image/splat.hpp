// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace cloudgen::image {

/// A puff as scenes hold it: a Gaussian with an opacity through its centre along its shortest axis.
struct Splat {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opacity = 1;
  glm::vec3 color{1};       ///< display-encoded (sRGB)
  glm::vec3 towardsSun{0};  ///< added when one looks straight towards the sun, subtracted when away from it
};

}  // namespace cloudgen::image
