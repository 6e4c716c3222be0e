// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "shape/placement.hpp"

namespace cloudgen::shape {

/// theta = 2 pi U, phi = pi U (pi/2 for a half sphere), r = M U; X = r cos theta sin phi, Y = r cos phi,
/// Z = r sin theta sin phi (the thesis prints cos phi for Z, a slip). Uniform in volume: cos phi uniform, r =
/// M U^(1/3). Incremental: r steps.
std::vector<glm::dvec3> placeSpherical(const Placement& placement, int count, base::RandomStream& stream) {
  const bool half = placement.system == CoordinateSystem::HalfSpherical;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double theta = 2.0 * std::numbers::pi * stream.uniform(), u = stream.uniform(),
                 v = stream.uniform();
    double phi = (half ? 0.5 : 1.0) * std::numbers::pi * u;
    double r = placement.radius * v;
    if (placement.variant == PlacementVariant::Uniform) {
      phi = std::acos(half ? u : 2.0 * u - 1.0);
      r = placement.radius * std::cbrt(v);
    } else if (placement.variant == PlacementVariant::Incremental) {
      r = placement.radius * i / count;
    }
    points.emplace_back(r * std::cos(theta) * std::sin(phi), r * std::cos(phi),
                        r * std::sin(theta) * std::sin(phi));
  }
  return points;
}

}  // namespace cloudgen::shape
