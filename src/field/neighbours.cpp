// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

int around(int column, int columns) { return (column % columns + columns) % columns; }

/// Cells of a row whose x meets [low, high], borders included.
void appendMeeting(const Grid& grid, int row, double low, double high, double periodX,
                   std::vector<std::uint32_t>& found) {
  const int columns = columnsOf(grid, row);
  const double step = stepOfRow(grid, row), first = planeX(grid, row, 0);
  double from = (low - first) / step, to = (high - first) / step;
  if (from > to) std::swap(from, to);
  constexpr double kTouching = 1e-7;
  const double period = periodX / std::abs(step);
  // Rows that do not go around may still be counted from elsewhere: -30 degrees in one, 330 in another.
  const int turns = grid.wrapsLongitude || periodX == 0 ? 0 : 1;
  for (int turn = -turns; turn <= turns; ++turn) {
    int begin = static_cast<int>(std::floor(from + turn * period - kTouching)),
        end = static_cast<int>(std::floor(to + turn * period + kTouching));
    if (grid.wrapsLongitude) end = std::min(end, begin + columns - 1);
    for (int column = begin; column <= end; ++column) {
      if (grid.wrapsLongitude)
        found.push_back(cellAt(grid, around(column, columns), row));
      else if (column >= 0 && column < columns)
        found.push_back(cellAt(grid, column, row));
    }
  }
}

void appendReduced(const Grid& grid, std::uint32_t cell, std::vector<std::uint32_t>& found) {
  const int row = grid.row(cell), column = grid.column(cell);
  const double periodX = projectionOf(grid, row)->periodX();
  for (int next = std::max(0, row - 1); next <= std::min(grid.rows - 1, row + 1); ++next)
    if (columnsOf(grid, next) > 0)
      appendMeeting(grid, next, planeX(grid, row, column), planeX(grid, row, column + 1), periodX, found);
}

void appendLattice(const Grid& grid, std::uint32_t cell, std::vector<std::uint32_t>& found) {
  const int rows = latticeRows(grid), row = grid.row(cell), half = row / rows;
  for (int rowStep = -1; rowStep <= 1; ++rowStep)
    for (int columnStep = -1; columnStep <= 1; ++columnStep) {
      const int nextRow = row + rowStep;
      int column = grid.column(cell) + columnStep;
      if (grid.wrapsLongitude) column = around(column, grid.columns);
      if (nextRow < half * rows || nextRow >= (half + 1) * rows || column < 0 || column >= grid.columns)
        continue;
      found.push_back(grid.index(column, nextRow));
    }
}

/// Across the equator of two hemispheres: cells of the other half, mirrored at the seam, whose centre is no
/// further away than that of a diagonal neighbour would be.
void appendMirrored(const Grid& grid, std::uint32_t cell, std::vector<std::uint32_t>& found) {
  constexpr double kReach = 1.5;
  const GeoPoint center = centerOf(grid, cell);
  const auto sideOf = [&](std::uint32_t one) {
    const glm::dvec2 sides = cellSidesMeters(grid, one);
    return 0.5 * (sides.x + sides.y) / kEarthRadiusMeters;
  };
  const double side = sideOf(cell);
  if (std::abs(center.latitudeDegrees) * kDegree > 2 * kReach * side) return;
  const int rows = latticeRows(grid), other = grid.row(cell) < rows ? 1 : 0;
  const auto middle = latticeCellOfHalf(grid, other, center);
  if (!middle) return;
  for (int row = grid.row(*middle) - 3; row <= grid.row(*middle) + 3; ++row)
    for (int column = grid.column(*middle) - 3; column <= grid.column(*middle) + 3; ++column) {
      if (row < other * rows || row >= (other + 1) * rows || column < 0 || column >= grid.columns) continue;
      const std::uint32_t next = grid.index(column, row);
      if (!counts(grid, next)) continue;
      const double reach = kReach * 0.5 * (side + sideOf(next));
      if (angleBetween(vectorOf(center), vectorOf(centerOf(grid, next))) < reach) found.push_back(next);
    }
}

}  // namespace

std::vector<std::uint32_t> neighbours(const Grid& grid, std::uint32_t cell) {
  std::vector<std::uint32_t> found;
  if (!grid.reducedRows.empty())
    appendReduced(grid, cell, found);
  else
    appendLattice(grid, cell, found);
  if (!grid.southCrs.empty()) {
    if (!counts(grid, cell)) return {};
    std::erase_if(found, [&](std::uint32_t next) { return !counts(grid, next); });
    appendMirrored(grid, cell, found);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::erase(found, cell);
  return found;
}

}  // namespace cloudgen::field
