// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/wrf_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/projection.hpp"
#include "base/text.hpp"
#include "input/netcdf/lattice.hpp"
#include "input/netcdf/map_projection.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr double kTolerableMeters = 10;
constexpr double kMostCells = 1 << 24;

/// MAP_PROJ of the WRF registry: 1 Lambert, 2 polar stereographic, 3 Mercator, 6 latitude-longitude.
enum MapProjection { kLambert = 1, kPolar = 2, kMercator = 3, kLatLon = 6 };

std::string definition(const File& file) {
  const auto of = [&](const char* name, double otherwise = 0) {
    return base::shortest(file.number(name).value_or(otherwise));
  };
  const std::string sphere = " +R=6370000";
  switch (static_cast<int>(std::lround(file.number("MAP_PROJ").value_or(0)))) {
    case kLambert:
      return "+proj=lcc +lat_1=" + of("TRUELAT1") + " +lat_2=" + of("TRUELAT2") +
             " +lat_0=" + of("MOAD_CEN_LAT", file.number("CEN_LAT").value_or(0)) +
             " +lon_0=" + of("STAND_LON") + sphere;
    case kPolar: {
      const bool south = file.number("TRUELAT1").value_or(0) < 0;
      return std::string("+proj=stere +lat_0=") + (south ? "-90" : "90") + " +lat_ts=" + of("TRUELAT1") +
             " +lon_0=" + of("STAND_LON") + sphere;
    }
    case kMercator:
      return "+proj=merc +lat_ts=" + of("TRUELAT1") + " +lon_0=" + of("STAND_LON") + sphere;
    case kLatLon: {
      const double poleLatitude = file.number("POLE_LAT").value_or(90);
      if (std::abs(poleLatitude - 90) < 1e-3) return "+proj=longlat" + sphere;
      return "+proj=ob_tran +o_proj=longlat +o_lat_p=" + base::shortest(poleLatitude) +
             " +o_lon_p=" + base::shortest(180 - file.number("POLE_LON").value_or(0)) +
             " +lon_0=" + base::shortest(-file.number("STAND_LON").value_or(0)) + sphere;
    }
    default:
      return {};
  }
}

struct Places {
  std::size_t columns = 0, rows = 0;
  std::vector<double> longitudes, latitudes;
};

/// Of the first time; moving nests are not followed.
Places readPlaces(const File& file) {
  const Variable *latitude = file.find("XLAT"), *longitude = file.find("XLONG");
  const std::size_t rank = latitude->dimensions.size();
  if (rank < 2 || rank > 3 || longitude->dimensions != latitude->dimensions)
    throw base::InputError(file.where(*latitude), "has no rows and columns", "fetch the file again");
  Places places;
  places.rows = file.dimensions()[latitude->dimensions[rank - 2]].length;
  places.columns = file.dimensions()[latitude->dimensions[rank - 1]].length;
  if (places.rows == 0 || places.columns == 0 ||
      (rank == 3 && file.dimensions()[latitude->dimensions[0]].length == 0))
    throw base::InputError(file.where(*latitude), "is empty", "fetch the file again");
  if (static_cast<double>(places.rows) * static_cast<double>(places.columns) > kMostCells)
    throw base::InputError(file.where(*latitude), "has an absurd number of cells", "fetch the file again");
  std::vector<std::size_t> start(rank, 0), count(rank, 1);
  count[rank - 2] = places.rows;
  count[rank - 1] = places.columns;
  places.latitudes = file.values(*latitude, start, count);
  places.longitudes = file.values(*longitude, start, count);
  return places;
}

/// Best fit of steps and start to the four corners, which single precision places to about a metre.
std::optional<field::Grid> latticeThrough(const std::string& crs, const Places& places, const File& file) {
  const std::size_t columns = places.columns, rows = places.rows;
  if (crs.empty() || columns < 2 || rows < 2) return std::nullopt;
  const auto map = base::Projection::of(crs);
  const bool degrees = map->inDegrees();
  const auto corner = [&](std::size_t column, std::size_t row) {
    const std::size_t place = row * columns + column;
    return map->toPlane({places.longitudes[place], places.latitudes[place]});
  };
  const auto westward = corner(0, 0), eastward = corner(columns - 1, 0), northward = corner(0, rows - 1),
             far = corner(columns - 1, rows - 1);
  field::Grid grid;
  grid.crs = crs;
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  const auto last = [](std::size_t count) { return static_cast<double>(count - 1); };
  double width = 0.5 * (eastward.x - westward.x + far.x - northward.x);
  if (degrees && width < 0) width += 360;
  // DX and DY are exact where the map is in metres; of degrees the corners tell.
  grid.stepX = degrees ? width / last(columns) : file.number("DX").value_or(width / last(columns));
  const double height = 0.5 * (northward.y - westward.y + far.y - eastward.y);
  grid.stepY = degrees ? height / last(rows) : file.number("DY").value_or(height / last(rows));
  if (degrees) {
    grid.firstX = westward.x;
  } else {
    grid.firstX = 0.25 * (westward.x + eastward.x + northward.x + far.x) - 0.5 * last(columns) * grid.stepX;
  }
  grid.firstY = 0.25 * (westward.y + eastward.y + northward.y + far.y) - 0.5 * last(rows) * grid.stepY;
  grid.wrapsLongitude = degrees && std::abs(columns * grid.stepX - 360) < 0.02 * grid.stepX;
  if (!std::isfinite(grid.firstX + grid.firstY + grid.stepX + grid.stepY) || !(std::abs(grid.stepX) > 0) ||
      !(std::abs(grid.stepY) > 0))
    return std::nullopt;
  return grid;
}

double distanceMeters(const field::Grid& grid, const Places& places) {
  std::vector<KnownPlace> known;
  const std::size_t stepRows = std::max<std::size_t>(1, places.rows / 32),
                    stepColumns = std::max<std::size_t>(1, places.columns / 32);
  for (std::size_t row = 0; row < places.rows; row += stepRows)
    for (std::size_t column = 0; column < places.columns; column += stepColumns) {
      const std::size_t place = row * places.columns + column;
      known.push_back({static_cast<double>(column),
                       static_cast<double>(row),
                       {places.longitudes[place], places.latitudes[place]}});
    }
  return greatestDistanceMeters(grid, known);
}

}  // namespace

Horizontal wrfGrid(const File& file, Builder& builder) {
  const Places places = readPlaces(file);
  const std::string crs = definition(file), where = file.where(*file.find("XLAT"));
  Horizontal result;
  result.columns = places.columns;
  result.rows = places.rows;
  std::optional<field::Grid> lattice;
  try {
    lattice = latticeThrough(crs, places, file);
  } catch (const base::InputError& error) {
    builder.warn("projection_unknown", error.problem());
  }
  const double distance = lattice ? distanceMeters(*lattice, places) : 0;
  if (lattice && distance <= kTolerableMeters) {
    result.key = fmt::format("{} {} {} {} {} {}x{}", crs, lattice->firstX, lattice->firstY, lattice->stepX,
                             lattice->stepY, places.columns, places.rows);
    result.make = [grid = *lattice] { return grid; };
    return result;
  }
  if (lattice)
    builder.warn(
        "projection_disagrees",
        fmt::format("MAP_PROJ puts cells up to {:.0f} m from XLAT and XLONG, which are taken instead",
                    distance));
  result.key =
      fmt::format("centres {}x{} {} {} {} {}", places.columns, places.rows, places.longitudes.front(),
                  places.latitudes.front(), places.longitudes.back(), places.latitudes.back());
  const auto shared = std::make_shared<const Places>(places);
  result.make = [shared, where] {
    return gridOfCenters(where, shared->columns, shared->rows, shared->longitudes, shared->latitudes);
  };
  return result;
}

}  // namespace cloudgen::input::netcdf
