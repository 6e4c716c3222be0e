// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "shape/placement.hpp"

namespace cloudgen::shape {

/// theta = 2 pi U, r = M U, Y = H U. Uniform in volume: r = M U^(1/2). Incremental: r steps.
std::vector<glm::dvec3> placeConical(const Placement& placement, int count, base::RandomStream& stream) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double theta = 2.0 * std::numbers::pi * stream.uniform(), u = stream.uniform();
    const double y = placement.height * stream.uniform();
    double r = placement.radius * u;
    if (placement.variant == PlacementVariant::Uniform) r = placement.radius * std::sqrt(u);
    if (placement.variant == PlacementVariant::Incremental) r = placement.radius * i / count;
    points.emplace_back(r * std::cos(theta), y, r * std::sin(theta));
  }
  return points;
}

}  // namespace cloudgen::shape
