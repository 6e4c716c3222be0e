// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace cloudgen::base {

/// A box in degrees. Where west > east it crosses the antimeridian. Longitudes are in [-180, 180].
struct GeoBox {
  double west = 0, south = 0, east = 0, north = 0;

  /// Eastward extent in degrees, in (0, 360].
  double width() const { return east > west ? east - west : east - west + 360.0; }
  double height() const { return north - south; }
  bool crossesAntimeridian() const { return west > east; }
  /// Longitudes are compared modulo 360; the borders belong to the box.
  bool contains(double longitudeDegrees, double latitudeDegrees) const;
  double centerLongitude() const;
  double centerLatitude() const { return 0.5 * (south + north); }
};

/// The longitude brought to [-180, 180).
double wrappedLongitude(double longitudeDegrees);

/// Reads "W,S,E,N" in degrees. Throws UsageError with what is wrong.
GeoBox boxFromText(const std::string& text);

/// The scene frame: metres, x east, y up (height above mean sea level), z south, origin at the box's
/// south-west corner at sea level. The horizontal mapping (by PROJ, WGS84) is equal-area, so that cloud cover
/// is true everywhere in the scene: Lambert azimuthal, tangent at the box's centre; for boxes wider than 150
/// degrees tangent at the pole if they lie about one, else Lambert cylindrical true at 30 degrees (azimuthal
/// maps have no antipode).
class LocalFrame {
 public:
  explicit LocalFrame(const GeoBox& box);

  const GeoBox& box() const { return box_; }
  /// The PROJ definition of the horizontal mapping, for reports.
  const std::string& definition() const { return definition_; }
  glm::dvec3 toScene(double longitudeDegrees, double latitudeDegrees, double heightMeters) const;
  /// (longitude, latitude) in degrees and height in metres.
  glm::dvec3 toGeographic(const glm::dvec3& scene) const;
  /// Unit vectors of true east and north at a place, as (x, z) of the scene; they turn with longitude away
  /// from the centre.
  glm::dvec2 eastDirection(double longitudeDegrees, double latitudeDegrees) const;
  /// Extent of the box in the scene: smallest and largest x (x component) and z (y component) along its
  /// borders.
  glm::dvec2 lowerCorner() const { return lower_; }
  glm::dvec2 upperCorner() const { return upper_; }

 private:
  GeoBox box_;
  std::string definition_;
  std::shared_ptr<void> context_, projection_;
  glm::dvec2 origin_{0}, lower_{0}, upper_{0};
};

}  // namespace cloudgen::base
