// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace cloudgen::light {

/// The light that leaves a puff, in display-linear RGB (exposure applied, before the sRGB curve; may exceed 1
/// a little).
struct PuffLight {
  glm::vec3 color{1};  ///< in every direction: sun by multiple scattering, sky, ground
  float forward =
      0;  ///< extra radiance (times the sun's colour) seen when looking towards the sun: the silver lining
};

}  // namespace cloudgen::light
