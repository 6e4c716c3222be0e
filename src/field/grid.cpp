// SPDX-License-Identifier: Apache-2.0
#include "field/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "field/curvilinear.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {

int Grid::column(std::uint32_t index) const {
  if (!reducedRows.empty())
    return static_cast<int>(index - reducedRows[static_cast<std::size_t>(row(index))].start);
  return static_cast<int>(index % static_cast<std::uint32_t>(columns));
}

int Grid::row(std::uint32_t index) const {
  if (!reducedRows.empty()) {
    const auto next = std::upper_bound(
        reducedRows.begin(), reducedRows.end(), index,
        [](std::uint32_t cell, const ReducedRow& candidate) { return cell < candidate.start; });
    return static_cast<int>(next - reducedRows.begin()) - 1;
  }
  return static_cast<int>(index / static_cast<std::uint32_t>(columns));
}

std::vector<std::uint32_t> everyCell(const Grid& grid) {
  std::vector<std::uint32_t> cells(grid.size());
  std::iota(cells.begin(), cells.end(), 0u);
  return cells;
}

GeoPoint pointIn(const Grid& grid, std::uint32_t cell, double u, double v) {
  const int column = grid.column(cell), row = grid.row(cell);
  if (!grid.centers.empty()) {
    if (u == 0.5 && v == 0.5) {
      const GeoPoint& center = grid.centers[cell];
      return {base::wrappedLongitude(center.longitudeDegrees), center.latitudeDegrees};
    }
    return placeOf(curvilinearVector(grid, column + u, row + v));
  }
  const double x = planeX(grid, row, column + u), y = planeY(grid, row, v);
  if (isGeographic(grid)) return {base::wrappedLongitude(x), std::clamp(y, -90.0, 90.0)};
  const auto projection = projectionOf(grid, row);
  const glm::dvec2 place =
      projection->toGeographic({x, projection->inDegrees() ? std::clamp(y, -90.0, 90.0) : y});
  return {place.x, place.y};
}

GeoPoint centerOf(const Grid& grid, std::uint32_t cell) { return pointIn(grid, cell, 0.5, 0.5); }

glm::dvec2 cellSidesMeters(const Grid& grid, std::uint32_t cell) {
  if (isGeographic(grid)) {
    const int row = grid.row(cell);
    const Interval latitudes = rowInterval(grid, row);
    return {std::cos(centerOf(grid, cell).latitudeDegrees * kDegree) * std::abs(stepOfRow(grid, row)) *
                kDegree * kEarthRadiusMeters,
            (latitudes.high - latitudes.low) * kDegree * kEarthRadiusMeters};
  }
  const auto at = [&](double u, double v) { return vectorOf(pointIn(grid, cell, u, v)); };
  const glm::dvec3 center = at(0.5, 0.5);
  return kEarthRadiusMeters * glm::dvec2(angleBetween(at(0, 0.5), center) + angleBetween(center, at(1, 0.5)),
                                         angleBetween(at(0.5, 0), center) + angleBetween(center, at(0.5, 1)));
}

double axisAngle(const Grid& grid, std::uint32_t cell) {
  if (isGeographic(grid)) return 0;
  const GeoPoint center = centerOf(grid, cell);
  if (!isPlace(center)) return 0;
  const double longitude = center.longitudeDegrees * kDegree;
  const glm::dvec3 up = vectorOf(center), east(-std::sin(longitude), std::cos(longitude), 0);
  const glm::dvec3 along =
      vectorOf(pointIn(grid, cell, 0.75, 0.5)) - vectorOf(pointIn(grid, cell, 0.25, 0.5));
  const double sign = grid.centers.empty() && stepOfRow(grid, grid.row(cell)) < 0 ? -1 : 1;
  const double angle = std::atan2(sign * glm::dot(along, glm::cross(up, east)), sign * glm::dot(along, east));
  return std::isfinite(angle) ? angle : 0;
}

}  // namespace cloudgen::field
