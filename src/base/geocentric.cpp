// SPDX-License-Identifier: Apache-2.0
#include "base/geocentric.hpp"

#include <proj.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/error.hpp"

namespace cloudgen::base {

Geocentric::Geocentric()
    : context_(proj_context_create(), [](void* p) { proj_context_destroy(static_cast<PJ_CONTEXT*>(p)); }) {
  PJ* created = proj_create(static_cast<PJ_CONTEXT*>(context_.get()), "+proj=cart +ellps=WGS84");
  if (!created) throw InputError("PROJ", "knows no geocentric coordinates", "check the PROJ installation");
  conversion_ = std::shared_ptr<void>(
      created, [keep = context_](void* p) { proj_destroy(static_cast<PJ*>(p)); });
}

glm::dvec3 Geocentric::toEarth(const glm::dvec3& geographic) const {
  const PJ_COORD there =
      proj_trans(static_cast<PJ*>(conversion_.get()), PJ_FWD,
                 proj_coord(proj_torad(geographic.x), proj_torad(geographic.y), geographic.z, 0));
  return {there.xyz.x, there.xyz.y, there.xyz.z};
}

glm::dvec3 Geocentric::toGeographic(const glm::dvec3& earth) const {
  const PJ_COORD there = proj_trans(static_cast<PJ*>(conversion_.get()), PJ_INV,
                                    proj_coord(earth.x, earth.y, earth.z, 0));
  return {proj_todeg(there.lpz.lam), proj_todeg(there.lpz.phi), there.lpz.z};
}

glm::dmat4 eastNorthUp(double longitudeDegrees, double latitudeDegrees, const glm::dvec3& origin) {
  const double longitude = glm::radians(longitudeDegrees), latitude = glm::radians(latitudeDegrees);
  const double sinLon = std::sin(longitude), cosLon = std::cos(longitude), sinLat = std::sin(latitude),
               cosLat = std::cos(latitude);
  glm::dmat4 matrix(1);
  matrix[0] = {-sinLon, cosLon, 0, 0};
  matrix[1] = {-sinLat * cosLon, -sinLat * sinLon, cosLat, 0};
  matrix[2] = {cosLat * cosLon, cosLat * sinLon, sinLat, 0};
  matrix[3] = glm::dvec4(origin, 1);
  return matrix;
}

}  // namespace cloudgen::base
