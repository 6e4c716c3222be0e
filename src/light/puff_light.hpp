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

/// The same as display-encoded (sRGB) values, in which viewers add harmonics.
struct EncodedLight {
  glm::vec3 mean{1};        ///< over all directions
  glm::vec3 towardsSun{0};  ///< added times the cosine between the way one looks and the sun

  glm::vec3 seenAt(float cosine) const { return mean + cosine * towardsSun; }
};

/// Looking at an angle of cosine mu to the sun, a puff shows its colour plus max(0, mu) of what is encoded
/// with the forward light added; degrees 0 and 1 that fit this best (least squares over the sphere) are a
/// quarter and half of it.
EncodedLight encoded(const PuffLight& light, const glm::vec3& sunColor);

}  // namespace cloudgen::light
