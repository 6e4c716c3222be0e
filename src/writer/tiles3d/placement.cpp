// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/placement.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cloudgen::writer::tiles3d {

TilePlane Placement::planeAt(const glm::dvec3& geographic) const {
  return {geographic, base::eastNorthUp(geographic.x, geographic.y, globe_.toEarth(geographic))};
}

glm::dvec3 Placement::onPlane(const TilePlane& plane, const glm::dvec3& geographic) const {
  const glm::dvec3 off = globe_.toEarth(geographic) - glm::dvec3(plane.toEarth[3]);
  return base::yUp(glm::transpose(glm::dmat3(plane.toEarth)) * off);
}

glm::quat Placement::turn(const TilePlane& plane, const glm::dvec3& scene) const {
  constexpr double kStepMeters = 100;
  const auto at = [&](const glm::dvec3& step) { return onPlane(plane, geographic(scene + step)); };
  const glm::dvec3 here = at({0, 0, 0});
  const glm::dvec3 up = glm::normalize(at({0, kStepMeters, 0}) - here),
                   alongX = glm::normalize(at({kStepMeters, 0, 0}) - here),
                   alongZ = glm::normalize(at({0, 0, kStepMeters}) - here);
  // The map keeps areas, not angles: what its x and z have in common is the turn.
  const glm::dvec3 x = glm::normalize(alongX + glm::cross(up, alongZ));
  return glm::quat_cast(glm::mat3(glm::dmat3(x, up, glm::cross(x, up))));
}

}  // namespace cloudgen::writer::tiles3d
