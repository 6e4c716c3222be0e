// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>

namespace cloudgen::base {

/// Places on and above the WGS84 ellipsoid as Earth-centred, Earth-fixed coordinates (x through 0 N 0 E, z
/// through the north pole), by PROJ. An object serves one thread at a time.
class Geocentric {
 public:
  Geocentric();

  /// From longitude and latitude in degrees and height above the ellipsoid, metres.
  glm::dvec3 toEarth(const glm::dvec3& geographic) const;
  /// Longitude in [-180, 180] and latitude in degrees, height in metres.
  glm::dvec3 toGeographic(const glm::dvec3& earth) const;

 private:
  std::shared_ptr<void> context_, conversion_;
};

/// From a tangent plane to Earth-fixed coordinates: columns are the units of east, north and up at a place
/// (degrees), and `origin`, which is the place itself.
glm::dmat4 eastNorthUp(double longitudeDegrees, double latitudeDegrees, const glm::dvec3& origin);

/// Turns the vertical axis of a y-up frame (x east, y up, z south), as of glTF and of the scene, into z.
inline glm::dvec3 zUp(const glm::dvec3& yUp) { return {yUp.x, -yUp.z, yUp.y}; }
inline glm::dvec3 yUp(const glm::dvec3& zUp) { return {zUp.x, zUp.z, -zUp.y}; }

}  // namespace cloudgen::base
