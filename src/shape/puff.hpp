// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace cloudgen::shape {

/// The one primitive: a soft anisotropic Gaussian blob. Lengths in metres, y up.
struct Puff {
  glm::vec3 center{0};
  glm::vec3 sigma{1};              ///< standard deviations along the puff's own axes
  glm::quat rotation{1, 0, 0, 0};  ///< from the puff's axes to the cloud's
  float extinctionPerMeter = 0;    ///< at the centre
  std::uint16_t section = 0;       ///< which section of the cloud it belongs to, from 0
  std::uint16_t sprite = 0;        ///< tile of the genus's sprite atlas
  bool rain = false;               ///< precipitation below the cloud
};

/// Optical depth through the centre along an axis with standard deviation s: extinction * s * sqrt(2 pi).
float centralOpticalDepth(float extinctionPerMeter, float sigma);

/// Optical depth of a puff through its centre along its shortest axis: as it is seen at its broadest. What is
/// drawn with one opacity for all directions takes this one, so that sheets seen from above and threads seen
/// from the side are right.
float frontalOpticalDepth(const Puff& puff);

/// The integral of extinction over space, m2: extinction * (2 pi)^1.5 * product of the deviations.
double extinctionArea(const Puff& puff);

/// Standard deviation of the height of a puff's extinction, metres.
double heightDeviation(const Puff& puff);

struct Bounds {
  glm::vec3 lower{0}, upper{0};
};

/// The box around puffs out to `reach` standard deviations; zero for no puffs.
Bounds boundsOf(std::span<const Puff> puffs, float reach = 2.5f);

}  // namespace cloudgen::shape
