// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/map_projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/projection.hpp"
#include "base/text.hpp"

namespace cloudgen::input::netcdf {
namespace {

/// WGS84 and the sphere most models live on.
constexpr double kModelRadiusMeters = 6371229;

std::string term(const char* name, double value) {
  return fmt::format(" +{}={}", name, base::shortest(value));
}

std::string earth(const Variable& mapping) {
  const auto number = [&](const char* name) { return mapping.number(name); };
  if (const auto major = number("semi_major_axis"); major && *major > 1e6) {
    if (const auto flattening = number("inverse_flattening"); flattening && *flattening > 1)
      return term("a", *major) + term("rf", *flattening);
    if (const auto minor = number("semi_minor_axis"); minor && *minor > 1e6)
      return term("a", *major) + term("b", *minor);
    return term("R", *major);
  }
  if (const auto radius = number("earth_radius"); radius && *radius > 1e6) return term("R", *radius);
  return term("R", kModelRadiusMeters);
}

}  // namespace

std::optional<std::string> projection(const Variable& mapping) {
  const std::string name = mapping.text("grid_mapping_name");
  const auto of = [&](const char* attribute, double otherwise = 0) {
    return mapping.number(attribute).value_or(otherwise);
  };
  const std::vector<double> parallels = mapping.attributes.contains("standard_parallel")
                                            ? mapping.attributes.at("standard_parallel").numbers
                                            : std::vector<double>{};
  const double origin = of("latitude_of_projection_origin");
  const std::string shifts =
      term("x_0", of("false_easting")) + term("y_0", of("false_northing")) + earth(mapping);
  const std::string meridian = term("lon_0", of("longitude_of_central_meridian"));
  const std::string center = term("lat_0", origin) + term("lon_0", of("longitude_of_projection_origin"));
  if (name == "lambert_conformal_conic") {
    const double first = parallels.empty() ? origin : parallels.front();
    return "+proj=lcc" + term("lat_1", first) + term("lat_2", parallels.size() > 1 ? parallels[1] : first) +
           term("lat_0", origin) + meridian + shifts;
  }
  if (name == "polar_stereographic") {
    const double pole = origin < 0 || (origin == 0 && !parallels.empty() && parallels.front() < 0) ? -90 : 90;
    const double up = of("straight_vertical_longitude_from_pole", of("longitude_of_projection_origin"));
    const std::string scale = parallels.empty() ? term("k_0", of("scale_factor_at_projection_origin", 1))
                                                : term("lat_ts", parallels.front());
    return "+proj=stere" + term("lat_0", pole) + term("lon_0", up) + scale + shifts;
  }
  if (name == "mercator")
    return "+proj=merc" + term("lon_0", of("longitude_of_projection_origin")) +
           (parallels.empty() ? term("k_0", of("scale_factor_at_projection_origin", 1))
                              : term("lat_ts", parallels.front())) +
           shifts;
  if (name == "transverse_mercator")
    return "+proj=tmerc" + term("lat_0", origin) + meridian +
           term("k_0", of("scale_factor_at_central_meridian", 1)) + shifts;
  if (name == "lambert_azimuthal_equal_area") return "+proj=laea" + center + shifts;
  if (name == "azimuthal_equidistant") return "+proj=aeqd" + center + shifts;
  if (name == "stereographic")
    return "+proj=stere" + center + term("k_0", of("scale_factor_at_projection_origin", 1)) + shifts;
  if (name == "albers_conical_equal_area" && !parallels.empty())
    return "+proj=aea" + term("lat_1", parallels.front()) + term("lat_2", parallels.back()) +
           term("lat_0", origin) + meridian + shifts;
  if (name == "lambert_cylindrical_equal_area")
    return "+proj=cea" + term("lat_ts", parallels.empty() ? 0 : parallels.front()) + meridian + shifts;
  if (name == "geostationary")
    return "+proj=geos" + term("h", of("perspective_point_height", 35785831)) +
           term("lon_0", of("longitude_of_projection_origin")) +
           (mapping.text("sweep_angle_axis") == "x" ? " +sweep=x" : " +sweep=y") + shifts;
  if (name == "rotated_latitude_longitude")
    return "+proj=ob_tran +o_proj=longlat" + term("o_lat_p", of("grid_north_pole_latitude", 90)) +
           term("o_lon_p", of("north_pole_grid_longitude")) +
           term("lon_0", 180 + of("grid_north_pole_longitude")) + earth(mapping);
  if (name == "latitude_longitude") return "+proj=longlat" + earth(mapping);
  return std::nullopt;
}

namespace {

/// Along a great circle, by the haversine.
double distanceMeters(const field::GeoPoint& a, const field::GeoPoint& b) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double latitude = a.latitudeDegrees * kDegree, other = b.latitudeDegrees * kDegree;
  const double s = std::sin(0.5 * (other - latitude));
  const double t = std::sin(0.5 * kDegree * (b.longitudeDegrees - a.longitudeDegrees));
  const double h = s * s + std::cos(latitude) * std::cos(other) * t * t;
  return 2 * field::kEarthRadiusMeters * std::asin(std::min(1.0, std::sqrt(h)));
}

}  // namespace

double greatestDistanceMeters(const field::Grid& lattice, const std::vector<KnownPlace>& places) {
  const auto map = base::Projection::of(lattice.crs);
  double greatest = 0;
  for (const KnownPlace& known : places) {
    const glm::dvec2 found = map->toGeographic(
        {lattice.firstX + known.column * lattice.stepX, lattice.firstY + known.row * lattice.stepY});
    const double distance = distanceMeters({found.x, found.y}, known.place);
    // A comparison that is false for NaN would hide it.
    if (!(distance <= greatest)) greatest = distance;
  }
  return std::isnan(greatest) ? std::numeric_limits<double>::infinity() : greatest;
}

}  // namespace cloudgen::input::netcdf
