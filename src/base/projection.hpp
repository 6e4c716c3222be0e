// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cloudgen::base {

/// True of PROJ definitions whose x and y are longitude and latitude in degrees themselves.
bool isLongitudeLatitude(std::string_view definition);

/// A map projection by PROJ, between longitude and latitude in degrees and x, y in the units of its
/// definition (degrees for rotated longitude-latitude, metres as a rule for the others). Both are on the
/// sphere or ellipsoid of the definition: there is no shift of datum. What has no image becomes not a number.
/// An object serves one thread at a time.
class Projection {
 public:
  /// Throws InputError, naming the definition, if PROJ knows no such projection or cannot invert it.
  explicit Projection(const std::string& definition);

  /// The projection of a definition, made once a thread and kept.
  static std::shared_ptr<const Projection> of(const std::string& definition);

  glm::dvec2 toPlane(const glm::dvec2& longitudeLatitude) const;
  /// Longitude in [-180, 180).
  glm::dvec2 toGeographic(const glm::dvec2& plane) const;

  /// x after once around the Earth, in plane units; 0 where the plane does not repeat.
  double periodX() const { return periodX_; }
  /// Rotated (or plain) longitude and latitude: x and y are degrees on a sphere.
  bool inDegrees() const { return inDegrees_; }

 private:
  bool stepsAreRadians() const;
  double measurePeriod(const std::string& definition) const;

  std::shared_ptr<void> context_, operation_;
  bool identity_ = false, inDegrees_ = false, planeInRadians_ = false;
  double periodX_ = 0;
};

}  // namespace cloudgen::base
