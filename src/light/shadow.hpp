// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace cloudgen::light {

/// A cloud as it throws and meets shadows: an upright cylinder.
struct Caster {
  glm::vec3 base{0};  ///< middle of its base, scene frame
  float radiusMeters = 0, depthMeters = 0;
  float opticalDepth = 0;  ///< vertical
};

/// Share of the sunlight, 0..1, that comes down to each cloud through those that lie wholly or in part above
/// its top: what their slices above it let through by all orders of scattering, mean over its area. One grid
/// for the whole scene, of at most 1024 x 1024 cells, is thrown along the sun onto a level plane. Suns below
/// 8 degrees are taken there, as further shadows would fall beyond what is known.
std::vector<float> sunlightOf(std::span<const Caster> clouds, const glm::vec3& sunDirection);

}  // namespace cloudgen::light
