// SPDX-License-Identifier: Apache-2.0
#include "input/grib/plane.hpp"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.hpp"

namespace cloudgen::input::grib {

constexpr double kRadians = std::numbers::pi / 180;

PlanePoint toPlane(const std::string& crs, const field::GeoPoint& place, const std::string& where) {
  const std::unique_ptr<PJ_CONTEXT, void (*)(PJ_CONTEXT*)> context(
      proj_context_create(), [](PJ_CONTEXT* c) { proj_context_destroy(c); });
  proj_log_level(context.get(), PJ_LOG_NONE);
  const std::unique_ptr<PJ, void (*)(PJ*)> projection(proj_create(context.get(), crs.c_str()),
                                                      [](PJ* p) { proj_destroy(p); });
  if (!projection)
    throw base::InputError(where, "has an impossible projection (" + crs + ")", "fetch the file again");
  const PJ_COORD point =
      proj_trans(projection.get(), PJ_FWD,
                 proj_coord(place.longitudeDegrees * kRadians, place.latitudeDegrees * kRadians, 0, 0));
  if (!std::isfinite(point.xy.x) || !std::isfinite(point.xy.y))
    throw base::InputError(where, "has a first grid point outside its projection (" + crs + ")",
                           "fetch the file again");
  return {point.xy.x, point.xy.y};
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
