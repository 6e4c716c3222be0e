// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "field/grid.hpp"

namespace cloudgen::field {

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline bool isPlace(const GeoPoint& place) {
  return std::isfinite(place.longitudeDegrees) && std::isfinite(place.latitudeDegrees);
}

/// Unit vector of a place: x towards (0 E, 0 N), y towards (90 E, 0 N), z towards the north pole.
inline glm::dvec3 vectorOf(const GeoPoint& place) {
  const double longitude = place.longitudeDegrees * kDegree, latitude = place.latitudeDegrees * kDegree;
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

/// The place below a vector of any length but zero.
inline GeoPoint placeOf(const glm::dvec3& vector) {
  return {base::wrappedLongitude(std::atan2(vector.y, vector.x) / kDegree),
          std::atan2(vector.z, std::hypot(vector.x, vector.y)) / kDegree};
}

/// Angle between two unit vectors, radians; precise for small ones.
inline double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return 2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
}

/// Signed area of a triangle of great circles on the unit sphere, positive counter-clockwise from outside
/// (Van Oosterom & Strackee 1983).
inline double triangleArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 2 * std::atan2(glm::dot(a, glm::cross(b - a, c - a)),
                        1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

}  // namespace cloudgen::field
