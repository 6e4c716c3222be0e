// SPDX-License-Identifier: Apache-2.0
#include "shape/placement.hpp"

namespace cloudgen::shape {

/// X, Y, Z = C U. The literal form is uniform already; the incremental one steps Y.
std::vector<glm::dvec3> placeCubic(const Placement& placement, int count, base::RandomStream& stream) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double x = stream.uniform(), y = stream.uniform(), z = stream.uniform();
    const double stepped = static_cast<double>(i) / count;
    points.push_back(placement.radius *
                     glm::dvec3(x, placement.variant == PlacementVariant::Incremental ? stepped : y, z));
  }
  return points;
}

}  // namespace cloudgen::shape
