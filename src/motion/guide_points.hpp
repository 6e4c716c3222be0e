// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "motion/fluid.hpp"
#include "shape/puff.hpp"

namespace cloudgen::motion {

/// Carries places, metres from the lower corner of the box, with the flow for so long (midpoint rule).
void carryPoints(const Fluid& fluid, float seconds, std::span<glm::vec3> places);

/// How the puffs of a cloud move by themselves, over and over.
struct IdleLoop {
  float seconds = 0;                           ///< of one round
  std::vector<std::vector<glm::vec3>> shifts;  ///< of each puff's centre, metres, at evenly spaced times from 0
};

/// The air around a cloud.
struct IdleAir {
  float updraft = 1;        ///< m/s, of the middle of the cloud once its rise is set up
  glm::vec2 shear{0};       ///< of the wind along x and z, from the cloud's base to its top, m/s
  float stability = 1e-4f;  ///< squared Brunt-Vaisala frequency, 1/s2
};

/// The idle motion of a cloud of some puffs: its buoyancy drives a fluid around it, whose flow (less the mean wind)
/// carries the centres. Two rounds are reckoned and blended, so that the loop closes smoothly: at the end all is
/// as at the start, in place and in speed. `steps` >= 4 times a round.
IdleLoop idleLoop(std::span<const shape::Puff> puffs, const IdleAir& air, float seconds, int steps);

}  // namespace cloudgen::motion
