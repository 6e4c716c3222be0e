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

/// Half the sum of a cell's sides, in radians.
double sideOf(const Grid& grid, std::uint32_t cell) {
  const glm::dvec2 sides = cellSidesMeters(grid, cell);
  return 0.5 * (sides.x + sides.y) / kEarthRadiusMeters;
}

/// True of cells of two hemispheres that count but have a cell beside them, beyond the equator, that does
/// not.
bool atTheSeam(const Grid& grid, std::uint32_t cell) {
  const int rows = latticeRows(grid), half = grid.row(cell) / rows;
  for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const int column = grid.column(cell) + right, row = grid.row(cell) + down;
    const bool within = column >= 0 && column < grid.columns && row >= half * rows && row < (half + 1) * rows;
    if (!within || !counts(grid, grid.index(column, row))) return counts(grid, cell);
  }
  return false;
}

/// Across the equator of two hemispheres the halves mirror each other: cells at the seam are neighbours of
/// those that face them, and of those beside these.
void appendMirrored(const Grid& grid, std::uint32_t cell, std::vector<std::uint32_t>& found) {
  constexpr double kDiagonal = 1.5;
  const GeoPoint center = centerOf(grid, cell);
  const double side = sideOf(grid, cell);
  if (std::abs(center.latitudeDegrees) * kDegree > 2 * side || !atTheSeam(grid, cell)) return;
  const int rows = latticeRows(grid), other = grid.row(cell) < rows ? 1 : 0;
  const auto facing = latticeCellOfHalf(grid, other, {center.longitudeDegrees, 0});
  if (!facing) return;
  constexpr int kAround = 3;
  for (int row = grid.row(*facing) - kAround; row <= grid.row(*facing) + kAround; ++row)
    for (int column = grid.column(*facing) - kAround; column <= grid.column(*facing) + kAround; ++column) {
      if (row < other * rows || row >= (other + 1) * rows || column < 0 || column >= grid.columns) continue;
      const std::uint32_t next = grid.index(column, row);
      const double along =
          std::abs(base::wrappedLongitude(centerOf(grid, next).longitudeDegrees - center.longitudeDegrees));
      if (along * kDegree < kDiagonal * 0.5 * (side + sideOf(grid, next)) && atTheSeam(grid, next))
        found.push_back(next);
    }
}

/// False where no cell around can lie beyond the equator of its hemisphere, nor the cell itself.
bool nearTheEquator(const Grid& grid, std::uint32_t cell) {
  if (grid.southCrs.empty()) return false;
  const double pole = grid.row(cell) < latticeRows(grid) ? 1 : -1;
  // Cells are as long as their step at 60 degrees, and shorter towards the equator.
  const double around = 3 * std::max(std::abs(grid.stepX), std::abs(grid.stepY)) / kEarthRadiusMeters;
  return !(pole * centerOf(grid, cell).latitudeDegrees * kDegree > around);
}

}  // namespace

std::vector<std::uint32_t> neighbours(const Grid& grid, std::uint32_t cell) {
  std::vector<std::uint32_t> found;
  if (!grid.reducedRows.empty())
    appendReduced(grid, cell, found);
  else
    appendLattice(grid, cell, found);
  if (nearTheEquator(grid, cell)) {
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
