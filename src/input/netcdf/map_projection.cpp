// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/map_projection.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

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

class Map {
 public:
  explicit Map(const std::string& crs) : plain_(crs.starts_with("+proj=longlat")) {
    if (plain_) return;
    context_.reset(proj_context_create());
    proj_log_level(context_.get(), PJ_LOG_NONE);
    operation_.reset(proj_create(context_.get(), crs.c_str()));
  }

  std::optional<MapPoint> forward(const field::GeoPoint& place) const {
    if (plain_) return MapPoint{place.longitudeDegrees, place.latitudeDegrees};
    if (!operation_) return std::nullopt;
    const PJ_COORD there =
        proj_trans(operation_.get(), PJ_FWD,
                   proj_coord(proj_torad(place.longitudeDegrees), proj_torad(place.latitudeDegrees), 0, 0));
    if (!std::isfinite(there.xy.x) || !std::isfinite(there.xy.y)) return std::nullopt;
    if (proj_angular_output(operation_.get(), PJ_FWD))
      return MapPoint{proj_todeg(there.xy.x), proj_todeg(there.xy.y)};
    return MapPoint{there.xy.x, there.xy.y};
  }

  std::optional<field::GeoPoint> inverse(MapPoint point) const {
    if (plain_) return field::GeoPoint{point.x, point.y};
    if (!operation_) return std::nullopt;
    if (proj_angular_output(operation_.get(), PJ_FWD))
      point = {proj_torad(point.x), proj_torad(point.y)};
    const PJ_COORD there = proj_trans(operation_.get(), PJ_INV, proj_coord(point.x, point.y, 0, 0));
    if (!std::isfinite(there.lp.lam) || !std::isfinite(there.lp.phi)) return std::nullopt;
    return field::GeoPoint{proj_todeg(there.lp.lam), proj_todeg(there.lp.phi)};
  }

 private:
  struct Release {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* operation) const { proj_destroy(operation); }
  };
  bool plain_;
  std::unique_ptr<PJ_CONTEXT, Release> context_;
  std::unique_ptr<PJ, Release> operation_;
};

/// Along a great circle, by the haversine.
double distanceMeters(const field::GeoPoint& a, const field::GeoPoint& b) {
  const double latitude = proj_torad(a.latitudeDegrees), other = proj_torad(b.latitudeDegrees);
  const double s = std::sin(0.5 * (other - latitude));
  const double t = std::sin(0.5 * proj_torad(b.longitudeDegrees - a.longitudeDegrees));
  const double h = s * s + std::cos(latitude) * std::cos(other) * t * t;
  return 2 * field::kEarthRadiusMeters * std::asin(std::min(1.0, std::sqrt(h)));
}

}  // namespace

std::optional<MapPoint> onMap(const std::string& crs, const field::GeoPoint& place) {
  return Map(crs).forward(place);
}

double greatestDistanceMeters(const field::Grid& lattice, const std::vector<KnownPlace>& places) {
  const Map map(lattice.crs);
  double greatest = 0;
  for (const KnownPlace& known : places) {
    const auto found = map.inverse(
        {lattice.firstX + known.column * lattice.stepX, lattice.firstY + known.row * lattice.stepY});
    const double distance =
        found ? distanceMeters(*found, known.place) : std::numeric_limits<double>::infinity();
    // A comparison that is false for NaN would hide it.
    if (!(distance <= greatest)) greatest = distance;
  }
  return std::isnan(greatest) ? std::numeric_limits<double>::infinity() : greatest;
}

}  // namespace cloudgen::input::netcdf
