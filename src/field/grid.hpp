// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.hpp"

namespace cloudgen::field {

/// Mean radius of the Earth (IUGG R1).
inline constexpr double kEarthRadiusMeters = 6371008.8;

struct GeoPoint {
  double longitudeDegrees = 0, latitudeDegrees = 0;
};

/// A row of a reduced grid: `count` cells from `firstX`, `stepX` apart; the first has the index `start`.
struct ReducedRow {
  std::uint32_t start = 0;
  int count = 0;
  double firstX = 0, stepX = 0;
};

/// A horizontal model grid: cell centres at (firstX + column * stepX, firstY + row * stepY) in the units of
/// `crs` (degrees for geographic and rotated ones, metres for projected ones). Rows run in either direction
/// (stepY < 0: from the north). Latitudes of the model's sphere are taken as those of WGS84, as models mean
/// them. Three departures from the plain lattice, each absent where its member is empty:
struct Grid {
  std::string crs = "+proj=longlat +R=6371229";  ///< a PROJ definition; longlat, ob_tran or projected
  int columns = 0, rows = 0;                     ///< columns of the longest row
  double firstX = 0, firstY = 0, stepX = 0, stepY = 0;
  bool wrapsLongitude = false;  ///< column `columns` is column 0 again
  /// Centres of the rows where they are uneven (Gaussian grids); stepY is then their mean step.
  std::vector<double> rowY;
  /// Rows of their own length (reduced Gaussian, thinned latitude-longitude).
  std::vector<ReducedRow> reducedRows;
  /// Centres of all cells, row by row, where no projection gives them (curvilinear grids); crs, first and
  /// step are then unused.
  std::vector<GeoPoint> centers;
  /// A grid of two hemispheres (WWMCA): rows [0, rows/2) are the lattice in `crs` (north), rows [rows/2,
  /// rows) the same lattice in `southCrs`. Cells whose centre lies beyond the equator of their half do not
  /// count: they have no area and touch nothing, and the neighbour there is a cell of the other half.
  std::string southCrs;

  std::uint32_t size() const {
    if (!reducedRows.empty())
      return reducedRows.back().start + static_cast<std::uint32_t>(reducedRows.back().count);
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
  }
  /// Of grids without reduced rows.
  std::uint32_t index(int column, int row) const {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns) +
           static_cast<std::uint32_t>(column);
  }
  int column(std::uint32_t index) const;
  int row(std::uint32_t index) const;
};

/// 0 .. size - 1: to ask a source for all it has.
std::vector<std::uint32_t> everyCell(const Grid& grid);

/// Geographic position in a cell: (0.5, 0.5) is its centre, (0, 0) the corner towards column 0 and row 0.
/// Longitude in [-180, 180); latitude clamped to the poles.
GeoPoint pointIn(const Grid& grid, std::uint32_t cell, double u, double v);
GeoPoint centerOf(const Grid& grid, std::uint32_t cell);

/// Area of a cell on the sphere of the mean Earth radius, in square metres; 0 for cells that do not count.
double cellAreaSquareMeters(const Grid& grid, std::uint32_t cell);

/// Lengths of a cell along its row and along its column, through its centre, in metres.
glm::dvec2 cellSidesMeters(const Grid& grid, std::uint32_t cell);

/// Share of a cell's area that lies in the box, 0..1.
double shareInside(const Grid& grid, std::uint32_t cell, const base::GeoBox& box);

/// The cells that share area with the box (a common border alone does not count), by index, ascending;
/// empty if the box lies outside the grid.
std::vector<std::uint32_t> cellsTouching(const Grid& grid, const base::GeoBox& box);

/// The smallest box that holds the grid (cell borders, not centres). A pole inside makes it span all
/// longitudes and reach the pole; the antimeridian inside gives west > east.
base::GeoBox extent(const Grid& grid);

/// The cells that share a border or a corner with a cell, ascending; across the antimeridian, across the
/// equator of a grid of two hemispheres, and between reduced rows too.
std::vector<std::uint32_t> neighbours(const Grid& grid, std::uint32_t cell);

/// Direction in which x grows at a cell's centre: radians counter-clockwise from true east. A wind (u, v)
/// along the grid blows towards east u cos a - v sin a, north u sin a + v cos a.
double axisAngle(const Grid& grid, std::uint32_t cell);

/// Finds the cell that a place lies in. Made once for many places; one a thread.
class CellFinder {
 public:
  explicit CellFinder(const Grid& grid);
  ~CellFinder();
  /// Nothing outside the grid.
  std::optional<std::uint32_t> at(const GeoPoint& place) const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace cloudgen::field
