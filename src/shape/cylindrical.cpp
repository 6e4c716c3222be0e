// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "shape/placement.hpp"

namespace cloudgen::shape {

/// phi = alpha U, theta = 2 pi U, Y = H U, r = (H - Y) tan phi: wide below, pointed above.
/// Uniform in volume: the share of a cone's volume below y is 1 - (1 - y/H)^3, and r^2 is uniform in its
/// disc.
std::vector<glm::dvec3> placeCylindrical(const Placement& placement, int count, base::RandomStream& stream) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double u = stream.uniform(), theta = 2.0 * std::numbers::pi * stream.uniform(),
                 v = stream.uniform();
    const double height = placement.height;
    double y = height * v, r = (height - y) * std::tan(placement.angleRadians * u);
    if (placement.variant == PlacementVariant::Uniform) {
      y = height * (1.0 - std::cbrt(1.0 - v));
      r = (height - y) * std::tan(placement.angleRadians) * std::sqrt(u);
    } else if (placement.variant == PlacementVariant::Incremental) {
      y = height * i / count;
      r = (height - y) * std::tan(placement.angleRadians * u);
    }
    points.emplace_back(r * std::cos(theta), y, r * std::sin(theta));
  }
  return points;
}

}  // namespace cloudgen::shape
