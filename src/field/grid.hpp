// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/frame.hpp"

namespace cloudgen::field {

/// Mean radius of the Earth (IUGG R1).
inline constexpr double kEarthRadiusMeters = 6371008.8;

/// A horizontal model grid: cell centres at (firstX + column * stepX, firstY + row * stepY) in the units of
/// `crs` (degrees for geographic grids, metres for projected ones). Rows run in either direction (stepY < 0:
/// from the north).
struct Grid {
  std::string crs = "+proj=longlat +R=6371229 +type=crs";
  int columns = 0, rows = 0;
  double firstX = 0, firstY = 0, stepX = 0, stepY = 0;
  bool wrapsLongitude = false;  ///< column `columns` is column 0 again

  std::uint32_t size() const {
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
  }
  std::uint32_t index(int column, int row) const {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns) +
           static_cast<std::uint32_t>(column);
  }
  int column(std::uint32_t index) const {
    return static_cast<int>(index % static_cast<std::uint32_t>(columns));
  }
  int row(std::uint32_t index) const { return static_cast<int>(index / static_cast<std::uint32_t>(columns)); }
};

struct GeoPoint {
  double longitudeDegrees = 0, latitudeDegrees = 0;
};

/// Geographic position of a point of the grid in fractional column and row: (0, 0) is the first cell's
/// centre,
/// (-0.5, -0.5) its outer corner. Longitude in [-180, 180). Latitude is clamped to the poles.
GeoPoint pointAt(const Grid& grid, double column, double row);

/// Area of a cell on the sphere of the mean Earth radius, in square metres.
double cellAreaSquareMeters(const Grid& grid, std::uint32_t index);

/// The cells that share area with the box (a common border alone does not count), by index, ascending;
/// empty if the box lies outside the grid.
std::vector<std::uint32_t> cellsTouching(const Grid& grid, const base::GeoBox& box);

/// The box that the grid covers (cell borders, not centres).
base::GeoBox extent(const Grid& grid);

/// The neighbour `columnStep` and `rowStep` away; -1 where there is none.
std::int64_t neighbour(const Grid& grid, std::uint32_t index, int columnStep, int rowStep);

}  // namespace cloudgen::field
