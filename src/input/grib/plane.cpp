// SPDX-License-Identifier: Apache-2.0
#include "input/grib/plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/projection.hpp"

namespace cloudgen::input::grib {

constexpr double kRadians = std::numbers::pi / 180;

glm::dvec2 toPlane(const std::string& crs, const field::GeoPoint& place, const std::string& where) {
  const auto refuse = [&](const char* what) {
    return base::InputError(where, fmt::format("has {} ({})", what, crs), "fetch the file again");
  };
  glm::dvec2 point;
  try {
    point = base::Projection::of(crs)->toPlane({place.longitudeDegrees, place.latitudeDegrees});
  } catch (const base::InputError&) {
    throw refuse("an impossible projection");
  }
  if (!std::isfinite(point.x) || !std::isfinite(point.y))
    throw refuse("a first grid point outside its projection");
  return point;
}

field::GeoPoint aboutCenter(const field::GeoPoint& center, const field::GeoPoint& place) {
  const double longitude = (place.longitudeDegrees - center.longitudeDegrees) * kRadians;
  const double latitude = place.latitudeDegrees * kRadians, tilt = center.latitudeDegrees * kRadians;
  const double x = std::cos(latitude) * std::cos(longitude), y = std::cos(latitude) * std::sin(longitude),
               z = std::sin(latitude);
  const double turnedX = x * std::cos(tilt) + z * std::sin(tilt),
               turnedZ = z * std::cos(tilt) - x * std::sin(tilt);
  return {std::atan2(y, turnedX) / kRadians, std::asin(std::clamp(turnedZ, -1.0, 1.0)) / kRadians};
}

}  // namespace cloudgen::input::grib
