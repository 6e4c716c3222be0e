// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/projection.hpp"
#include "field/grid.hpp"

/// The lattice of a grid in the plane of its projection: what the functions of grid.hpp are made of. For
/// grids without `centers`.
namespace cloudgen::field {

/// Borders that differ by less than this many degrees (a tenth of a millimetre) are the same border.
inline constexpr double kSameDegrees = 1e-9;

struct Interval {
  double low = 0, high = 0;
};

/// Longitude and latitude are the grid's own axes.
inline bool isGeographic(const Grid& grid) {
  return grid.centers.empty() && base::isLongitudeLatitude(grid.crs);
}

/// The projection of the half that a row is in; this thread's.
std::shared_ptr<const base::Projection> projectionOf(const Grid& grid, int row);

/// Rows of a lattice: all, or half of those of two hemispheres.
inline int latticeRows(const Grid& grid) { return grid.southCrs.empty() ? grid.rows : grid.rows / 2; }

/// Cells of a row.
inline int columnsOf(const Grid& grid, int row) {
  return grid.reducedRows.empty() ? grid.columns : grid.reducedRows[static_cast<std::size_t>(row)].count;
}

/// The index of a cell, in reduced rows too.
inline std::uint32_t cellAt(const Grid& grid, int column, int row) {
  if (grid.reducedRows.empty()) return grid.index(column, row);
  return grid.reducedRows[static_cast<std::size_t>(row)].start + static_cast<std::uint32_t>(column);
}

double stepOfRow(const Grid& grid, int row);
/// x at (column + u), where a column reaches from u = 0 to 1.
double planeX(const Grid& grid, int row, double columnAndU);
double planeY(const Grid& grid, int row, double v);

/// Borders of a row in plane units; where those are degrees, cut at the poles.
Interval rowInterval(const Grid& grid, int row);

/// False for cells beyond the equator of their hemisphere, and for those that have no place on Earth.
bool counts(const Grid& grid, std::uint32_t cell);

/// The cell of a lattice that holds a place.
std::optional<std::uint32_t> latticeCell(const Grid& grid, const GeoPoint& place);

/// The cell of the northern (half 0) or southern (half 1) lattice that holds a place, whether it counts or
/// not.
std::optional<std::uint32_t> latticeCellOfHalf(const Grid& grid, int half, const GeoPoint& place);

}  // namespace cloudgen::field
