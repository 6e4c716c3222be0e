// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/projection.hpp"
#include "field/grid.hpp"

/// Small grids of each kind, as real models have them.
namespace cloudgen::field::trial {

/// GFS at 2.5 degrees, from the north pole, from Greenwich eastwards.
inline Grid global() {
  Grid grid;
  grid.columns = 144, grid.rows = 73;
  grid.firstX = 0, grid.firstY = 90, grid.stepX = 2.5, grid.stepY = -2.5;
  grid.wrapsLongitude = true;
  return grid;
}

/// A lattice whose first centre is at a place.
inline Grid projected(const std::string& crs, int columns, int rows, double step, const GeoPoint& first) {
  Grid grid;
  grid.crs = crs;
  grid.columns = columns, grid.rows = rows, grid.stepX = grid.stepY = step;
  const glm::dvec2 place = base::Projection(crs).toPlane({first.longitudeDegrees, first.latitudeDegrees});
  grid.firstX = place.x, grid.firstY = place.y;
  return grid;
}

/// NCEP grid 211: Lambert, North America.
inline Grid lambert() {
  return projected("+proj=lcc +lat_0=25 +lat_1=25 +lat_2=25 +lon_0=-95 +R=6371229", 93, 65, 81271,
                   {226.541, 12.19});
}

/// COSMO: rotated longitude and latitude.
inline Grid rotated() {
  Grid grid;
  grid.crs = "+proj=ob_tran +o_proj=longlat +o_lat_p=40 +o_lon_p=0 +lon_0=10 +R=6371229";
  grid.columns = 40, grid.rows = 30;
  grid.firstX = -10, grid.firstY = -7, grid.stepX = 0.5, grid.stepY = 0.5;
  return grid;
}

/// Around the Arctic, the pole in the middle of a cell.
inline Grid polar() {
  Grid grid;
  grid.crs = "+proj=stere +lat_0=90 +lat_ts=60 +lon_0=-45 +R=6371229";
  grid.columns = 41, grid.rows = 41, grid.stepX = grid.stepY = 100000;
  grid.firstX = grid.firstY = -20 * 100000.0;
  return grid;
}

/// Mercator over the Pacific; the antimeridian and the edge of the map are inside.
inline Grid mercator() {
  return projected("+proj=merc +lat_ts=10 +lon_0=0 +R=6370000", 60, 30, 100000, {160, -5});
}

/// Full Gaussian grid F16.
inline Grid gaussian() {
  Grid grid = global();
  grid.rowY = {85.7606, 80.2688, 74.7445, 69.2130, 63.6786, 58.1430, 52.6065, 47.0696,
               41.5325, 35.9951, 30.4576, 24.9199, 19.3822, 13.8445, 8.3067,  2.7689};
  for (int i = 15; i >= 0; --i) grid.rowY.push_back(-grid.rowY[static_cast<std::size_t>(i)]);
  grid.rows = 32, grid.columns = 64;
  grid.firstY = grid.rowY.front(), grid.stepX = 5.625, grid.stepY = -2 * 85.7606 / 31;
  return grid;
}

/// Octahedral reduced Gaussian grid O16: rows of 20, 24, ... cells.
inline Grid reduced() {
  Grid grid = gaussian();
  std::uint32_t start = 0;
  for (int row = 0; row < grid.rows; ++row) {
    const int count = 20 + 4 * std::min(row, grid.rows - 1 - row);
    grid.reducedRows.push_back({start, count, 0, 360.0 / count});
    start += static_cast<std::uint32_t>(count);
    grid.columns = std::max(row == 0 ? 0 : grid.columns, count);
  }
  return grid;
}

/// Thinned latitude-longitude octant of WAFS: from the equator to the pole, 330 to 60 degrees east.
inline Grid thinned() {
  Grid grid;
  grid.rows = 37, grid.columns = 37;
  grid.firstY = 0, grid.stepY = 2.5, grid.firstX = 330, grid.stepX = 2.5;
  std::uint32_t start = 0;
  for (int row = 0; row < grid.rows; ++row) {
    const int count = std::max(2, static_cast<int>(std::lround(2 + 35 * std::cos(row * 2.5 * 0.0174533))));
    grid.reducedRows.push_back({start, count, 330, 90.0 / (count - 1)});
    start += static_cast<std::uint32_t>(count);
  }
  return grid;
}

/// The two hemispheres of WWMCA, in coarser cells (64 a side) but with the same reach and orientation.
inline Grid hemispheres(int side = 64) {
  Grid grid;
  const double step = 23812.5 * 1024 / side;
  grid.crs = "+proj=stere +lat_0=90 +lat_ts=60 +lon_0=100 +R=6371221.3";
  grid.southCrs = "+proj=stere +lat_0=-90 +lat_ts=-60 +lon_0=100 +R=6371221.3";
  grid.columns = side, grid.rows = 2 * side;
  grid.stepX = grid.stepY = step;
  grid.firstX = grid.firstY = -(side / 2) * step;
  return grid;
}

/// A curvilinear grid with the centres of another one, which has no wrap.
inline Grid curvilinear(const Grid& other) {
  Grid grid;
  grid.columns = other.columns, grid.rows = other.rows;
  for (std::uint32_t cell = 0; cell < other.size(); ++cell) grid.centers.push_back(centerOf(other, cell));
  return grid;
}

struct Named {
  std::string name;
  Grid grid;
};

inline std::vector<Named> all() {
  return {{"global", global()},
          {"lambert", lambert()},
          {"rotated", rotated()},
          {"polar", polar()},
          {"mercator", mercator()},
          {"gaussian", gaussian()},
          {"reduced", reduced()},
          {"thinned", thinned()},
          {"hemispheres", hemispheres()},
          {"curvilinear lambert", curvilinear(lambert())},
          {"curvilinear polar", curvilinear(polar())}};
}

}  // namespace cloudgen::field::trial
