// SPDX-License-Identifier: Apache-2.0
#include "field/grid_plane.hpp"

#include <algorithm>
#include <cmath>

#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Of a cell: places nearer to the outer border of a grid than this are still inside.
constexpr double kBorderTolerance = 1e-6;

bool inDegrees(const Grid& grid) {
  return base::isLongitudeLatitude(grid.crs) || base::Projection::of(grid.crs)->inDegrees();
}

double unevenRow(const Grid& grid, int row) { return grid.rowY[static_cast<std::size_t>(row)]; }

/// The outer border of the first or last of uneven rows: as far out as the inner one is in, but up to the
/// pole where no further row would fit before it (as in Gaussian grids).
double outerBorder(const Grid& grid, int row, int inner) {
  const double y = unevenRow(grid, row);
  const double step = grid.rows > 1 ? y - unevenRow(grid, inner) : grid.stepY;
  const double border = y + 0.5 * step;
  if (!inDegrees(grid)) return border;
  const double pole = step > 0 ? 90 : -90;
  return std::abs(pole - y) < std::abs(step) ? pole : std::clamp(border, -90.0, 90.0);
}

/// The border between an uneven row and the one before it.
double unevenBorder(const Grid& grid, int row) {
  if (row == 0) return grid.rows > 1 ? outerBorder(grid, 0, 1) : unevenRow(grid, 0) - 0.5 * grid.stepY;
  if (row == grid.rows) return outerBorder(grid, grid.rows - 1, grid.rows - 2);
  return 0.5 * (unevenRow(grid, row - 1) + unevenRow(grid, row));
}

/// The row that y lies in.
std::optional<int> rowAt(const Grid& grid, double y) {
  if (grid.rowY.empty()) {
    const int rows = latticeRows(grid);
    const double along = (y - grid.firstY) / grid.stepY + 0.5;
    if (!(along > -kBorderTolerance && along < rows + kBorderTolerance)) return std::nullopt;
    return std::clamp(static_cast<int>(std::floor(along)), 0, rows - 1);
  }
  const double sign = unevenBorder(grid, grid.rows) > unevenBorder(grid, 0) ? 1 : -1;
  const double slack = kBorderTolerance * std::abs(grid.stepY);
  if (sign * (y - unevenBorder(grid, 0)) < -slack || sign * (y - unevenBorder(grid, grid.rows)) > slack)
    return std::nullopt;
  int low = 0, high = grid.rows;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (sign * (y - unevenBorder(grid, middle)) >= 0 ? low : high) = middle;
  }
  return low;
}

std::optional<int> columnAt(const Grid& grid, int row, double x, double periodX) {
  const int columns = columnsOf(grid, row);
  const double first = planeX(grid, row, 0), step = stepOfRow(grid, row);
  double along = (x - first) / step;
  if (periodX > 0) {
    const double around = periodX / std::abs(step);
    along -= around * std::floor(along / around);
    if (along > around - kBorderTolerance && along >= columns) along -= around;
  }
  if (grid.wrapsLongitude && along >= columns && along < columns + 0.5) along = along - columns;
  if (!(along > -kBorderTolerance && along < columns + kBorderTolerance)) return std::nullopt;
  return std::clamp(static_cast<int>(std::floor(along)), 0, columns - 1);
}

}  // namespace

std::shared_ptr<const base::Projection> projectionOf(const Grid& grid, int row) {
  const bool south = !grid.southCrs.empty() && row >= latticeRows(grid);
  return base::Projection::of(south ? grid.southCrs : grid.crs);
}

double stepOfRow(const Grid& grid, int row) {
  return grid.reducedRows.empty() ? grid.stepX : grid.reducedRows[static_cast<std::size_t>(row)].stepX;
}

double planeX(const Grid& grid, int row, double columnAndU) {
  if (grid.reducedRows.empty()) return grid.firstX + (columnAndU - 0.5) * grid.stepX;
  const ReducedRow& reduced = grid.reducedRows[static_cast<std::size_t>(row)];
  return reduced.firstX + (columnAndU - 0.5) * reduced.stepX;
}

double planeY(const Grid& grid, int row, double v) {
  if (grid.rowY.empty()) {
    const int rows = latticeRows(grid);
    return grid.firstY + ((row >= rows ? row - rows : row) + v - 0.5) * grid.stepY;
  }
  const double center = unevenRow(grid, row), border = unevenBorder(grid, v < 0.5 ? row : row + 1);
  return center + std::abs(v - 0.5) * 2 * (border - center);
}

Interval rowInterval(const Grid& grid, int row) {
  const double one = planeY(grid, row, 0), other = planeY(grid, row, 1);
  Interval borders{std::min(one, other), std::max(one, other)};
  if (inDegrees(grid)) {
    borders.low = std::clamp(borders.low, -90.0, 90.0);
    borders.high = std::clamp(borders.high, -90.0, 90.0);
  }
  return borders;
}

bool counts(const Grid& grid, std::uint32_t cell) {
  if (isGeographic(grid)) return true;
  const GeoPoint center = centerOf(grid, cell);
  if (!isPlace(center)) return false;
  if (grid.southCrs.empty()) return true;
  return grid.row(cell) < latticeRows(grid) ? center.latitudeDegrees >= 0 : center.latitudeDegrees < 0;
}

std::optional<std::uint32_t> latticeCellOfHalf(const Grid& grid, int half, const GeoPoint& place) {
  const int firstRow = half == 0 ? 0 : latticeRows(grid);
  const auto projection = projectionOf(grid, firstRow);
  const glm::dvec2 there = projection->toPlane({place.longitudeDegrees, place.latitudeDegrees});
  if (!std::isfinite(there.x) || !std::isfinite(there.y)) return std::nullopt;
  const auto row = rowAt(grid, there.y);
  if (!row || columnsOf(grid, firstRow + *row) == 0) return std::nullopt;
  const auto column = columnAt(grid, firstRow + *row, there.x, projection->periodX());
  if (!column) return std::nullopt;
  return cellAt(grid, *column, firstRow + *row);
}

std::optional<std::uint32_t> latticeCell(const Grid& grid, const GeoPoint& place) {
  if (!isPlace(place)) return std::nullopt;
  if (grid.southCrs.empty()) return latticeCellOfHalf(grid, 0, place);
  const int half = place.latitudeDegrees >= 0 ? 0 : 1;
  for (const int candidate : {half, 1 - half}) {
    const auto found = latticeCellOfHalf(grid, candidate, place);
    if (found && counts(grid, *found)) return found;
  }
  // In a gap along the equator, where the cell of either half has its centre beyond: the next one inwards.
  const auto beyond = latticeCellOfHalf(grid, half, place);
  if (!beyond) return std::nullopt;
  const GeoPoint center = centerOf(grid, *beyond);
  const double inwards =
      (half == 0 ? 1 : -1) * cellSidesMeters(grid, *beyond).x / (kEarthRadiusMeters * kDegree);
  const auto found =
      latticeCellOfHalf(grid, half, {place.longitudeDegrees, center.latitudeDegrees + inwards});
  return found && counts(grid, *found) ? found : std::nullopt;
}

}  // namespace cloudgen::field
