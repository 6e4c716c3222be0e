// SPDX-License-Identifier: Apache-2.0
#include "field/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cloudgen::field {
namespace {

/// Borders that differ by less than this many degrees (a tenth of a millimetre) are the same border.
constexpr double kSameDegrees = 1e-9;

[[maybe_unused]] bool isGeographic(const Grid& grid) { return grid.crs.starts_with("+proj=longlat"); }

/// The one place where grid units become degrees; a projected crs goes through PROJ here.
GeoPoint fromGridUnits([[maybe_unused]] const Grid& grid, double x, double y) {
  assert(isGeographic(grid));
  return {base::wrappedLongitude(x), std::clamp(y, -90.0, 90.0)};
}

struct Interval {
  double low = 0, high = 0;
};

/// Borders of a row in degrees of latitude, cut at the poles.
Interval latitudesOfRow(const Grid& grid, int row) {
  const double center = grid.firstY + row * grid.stepY, half = 0.5 * std::abs(grid.stepY);
  return {std::clamp(center - half, -90.0, 90.0), std::clamp(center + half, -90.0, 90.0)};
}

bool rowTouches(const Grid& grid, int row, const base::GeoBox& box) {
  const Interval latitudes = latitudesOfRow(grid, row);
  return latitudes.high > box.south + kSameDegrees && latitudes.low < box.north - kSameDegrees;
}

bool columnTouches(const Grid& grid, int column, const base::GeoBox& box) {
  const double width = std::abs(grid.stepX);
  const double west = grid.firstX + column * grid.stepX - 0.5 * width;
  const double eastward = (west - box.west) - 360.0 * std::floor((west - box.west) / 360.0);
  return eastward < box.width() - kSameDegrees || eastward + width > 360.0 + kSameDegrees;
}

}  // namespace

int Grid::column(std::uint32_t index) const {
  return static_cast<int>(index % static_cast<std::uint32_t>(columns));
}

int Grid::row(std::uint32_t index) const {
  return static_cast<int>(index / static_cast<std::uint32_t>(columns));
}

GeoPoint pointIn(const Grid& grid, std::uint32_t cell, double u, double v) {
  return fromGridUnits(grid, grid.firstX + (grid.column(cell) + u - 0.5) * grid.stepX,
                       grid.firstY + (grid.row(cell) + v - 0.5) * grid.stepY);
}

GeoPoint centerOf(const Grid& grid, std::uint32_t cell) { return pointIn(grid, cell, 0.5, 0.5); }

glm::dvec2 cellSidesMeters(const Grid& grid, std::uint32_t cell) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double latitude = centerOf(grid, cell).latitudeDegrees * kDegree;
  return {std::cos(latitude) * std::abs(grid.stepX) * kDegree * kEarthRadiusMeters,
          std::abs(grid.stepY) * kDegree * kEarthRadiusMeters};
}

double shareInside(const Grid& grid, std::uint32_t cell, const base::GeoBox& box) {
  const GeoPoint center = centerOf(grid, cell);
  const double halfX = 0.5 * std::abs(grid.stepX), halfY = 0.5 * std::abs(grid.stepY);
  const double west = base::wrappedLongitude(center.longitudeDegrees - box.centerLongitude());
  const double x = std::min(west + halfX, 0.5 * box.width()) - std::max(west - halfX, -0.5 * box.width());
  const double y = std::min(center.latitudeDegrees + halfY, box.north) -
                   std::max(center.latitudeDegrees - halfY, box.south);
  return std::clamp(x / (2 * halfX), 0.0, 1.0) * std::clamp(y / (2 * halfY), 0.0, 1.0);
}

double axisAngle(const Grid&, std::uint32_t) { return 0; }

struct CellFinder::Search {};
CellFinder::CellFinder(const Grid&) {}
CellFinder::~CellFinder() = default;
std::optional<std::uint32_t> CellFinder::at(const GeoPoint&) const { return std::nullopt; }

double cellAreaSquareMeters(const Grid& grid, std::uint32_t index) {
  assert(isGeographic(grid) && index < grid.size());
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Interval latitudes = latitudesOfRow(grid, grid.row(index));
  const double zone = std::sin(latitudes.high * kDegree) - std::sin(latitudes.low * kDegree);
  return kEarthRadiusMeters * kEarthRadiusMeters * std::abs(grid.stepX) * kDegree * zone;
}

std::vector<std::uint32_t> cellsTouching(const Grid& grid, const base::GeoBox& box) {
  assert(isGeographic(grid));
  std::vector<int> columns;
  for (int column = 0; column < grid.columns; ++column)
    if (columnTouches(grid, column, box)) columns.push_back(column);
  std::vector<std::uint32_t> cells;
  for (int row = 0; row < grid.rows; ++row)
    if (rowTouches(grid, row, box))
      for (const int column : columns) cells.push_back(grid.index(column, row));
  return cells;
}

base::GeoBox extent(const Grid& grid) {
  assert(isGeographic(grid));
  const Interval first = latitudesOfRow(grid, 0), last = latitudesOfRow(grid, grid.rows - 1);
  base::GeoBox box{-180, std::min(first.low, last.low), 180, std::max(first.high, last.high)};
  const double width = grid.columns * std::abs(grid.stepX);
  if (grid.wrapsLongitude || width >= 360.0 - kSameDegrees) return box;
  const double westmost = std::min(grid.firstX, grid.firstX + (grid.columns - 1) * grid.stepX);
  box.west = base::wrappedLongitude(westmost - 0.5 * std::abs(grid.stepX));
  box.east = base::wrappedLongitude(box.west + width);
  if (box.east == -180) box.east = 180;
  return box;
}

std::vector<std::uint32_t> neighbours(const Grid& grid, std::uint32_t cell) {
  std::vector<std::uint32_t> found;
  for (int rowStep = -1; rowStep <= 1; ++rowStep)
    for (int columnStep = -1; columnStep <= 1; ++columnStep) {
      const int row = grid.row(cell) + rowStep;
      int column = grid.column(cell) + columnStep;
      if (grid.wrapsLongitude) column = (column % grid.columns + grid.columns) % grid.columns;
      if (row < 0 || row >= grid.rows || column < 0 || column >= grid.columns) continue;
      if (grid.index(column, row) != cell) found.push_back(grid.index(column, row));
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace cloudgen::field
