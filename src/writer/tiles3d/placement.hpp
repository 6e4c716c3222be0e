// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "base/frame.hpp"
#include "base/geocentric.hpp"

namespace cloudgen::writer::tiles3d {

/// Where the tangent plane of a tile is: its middle (degrees, metres above the ellipsoid), and the way from
/// it (x east, y north, z up) to Earth-fixed coordinates.
struct TilePlane {
  glm::dvec3 middle{0};
  glm::dmat4 toEarth{1};
};

/// Takes places of a scene to the globe. Heights above mean sea level are taken for heights above the
/// ellipsoid. An object serves one thread at a time.
class Placement {
 public:
  explicit Placement(const base::GeoBox& box) : frame_(box) {}

  /// Longitude and latitude in degrees, height in metres.
  glm::dvec3 geographic(const glm::dvec3& scene) const { return frame_.toGeographic(scene); }
  glm::dvec3 scene(const glm::dvec3& geographic) const {
    return frame_.toScene(geographic.x, geographic.y, geographic.z);
  }
  TilePlane planeAt(const glm::dvec3& geographic) const;
  /// From degrees and metres to the axes of glTF on a plane: x east, y up, z south.
  glm::dvec3 onPlane(const TilePlane& plane, const glm::dvec3& geographic) const;
  /// How what stands at a place of the scene is turned on a plane: the map's east is not that of the globe,
  /// and up is another way there than in the plane's middle. What the map stretches is not told.
  glm::quat turn(const TilePlane& plane, const glm::dvec3& scene) const;

 private:
  base::LocalFrame frame_;
  base::Geocentric globe_;
};

}  // namespace cloudgen::writer::tiles3d
