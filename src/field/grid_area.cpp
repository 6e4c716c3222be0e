// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>

#include "field/cap.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Between two parallels, of a longitudinal extent of one degree, on the unit sphere.
double zoneArea(const Interval& latitudes) {
  return kDegree * (std::sin(latitudes.high * kDegree) - std::sin(latitudes.low * kDegree));
}

/// Of the polygon through the cell's border, `parts` pieces a side, on the unit sphere.
double polygonArea(const Grid& grid, std::uint32_t cell, int parts) {
  const glm::dvec3 center = vectorOf(centerOf(grid, cell));
  const auto border = [&](int step) {
    const double along = static_cast<double>(step % parts) / parts;
    switch (step / parts % 4) {
      case 0:
        return vectorOf(pointIn(grid, cell, along, 0));
      case 1:
        return vectorOf(pointIn(grid, cell, 1, along));
      case 2:
        return vectorOf(pointIn(grid, cell, 1 - along, 1));
      default:
        return vectorOf(pointIn(grid, cell, 0, 1 - along));
    }
  };
  double sum = 0;
  const glm::dvec3 first = border(0);
  glm::dvec3 from = first;
  for (int step = 1; step <= 4 * parts; ++step) {
    const glm::dvec3 to = step == 4 * parts ? first : border(step);
    sum += triangleArea(center, from, to);
    from = to;
  }
  return std::abs(sum);
}

/// Overlap of the cell's longitudes with the box's, degrees.
double sharedLongitudes(double west, double width, const base::GeoBox& box) {
  const double from = (west - box.west) - 360.0 * std::floor((west - box.west) / 360.0), to = from + width;
  return std::max(0.0, std::min(to, box.width()) - from) + std::max(0.0, std::min(to - 360, box.width()));
}

/// 1 within the box, 0 outside, a half on its border, so that the shares of boxes side by side add up.
double weightIn(const base::GeoBox& box, const GeoPoint& place) {
  if (!isPlace(place) || !box.contains(place.longitudeDegrees, place.latitudeDegrees)) return 0;
  const auto near = [](double a, double b) { return std::abs(base::wrappedLongitude(a - b)) < kSameDegrees; };
  const bool onBorder =
      box.width() < 360 && (near(place.longitudeDegrees, box.west) || near(place.longitudeDegrees, box.east));
  return onBorder ? 0.5 : 1;
}

}  // namespace

double cellAreaSquareMeters(const Grid& grid, std::uint32_t cell) {
  assert(cell < grid.size());
  constexpr double kSquare = kEarthRadiusMeters * kEarthRadiusMeters;
  if (grid.centers.empty()) {
    const int row = grid.row(cell);
    // A rotated sphere keeps its areas.
    if (base::isLongitudeLatitude(grid.crs) || projectionOf(grid, row)->inDegrees())
      return kSquare * std::abs(stepOfRow(grid, row)) * zoneArea(rowInterval(grid, row));
  }
  if (!grid.southCrs.empty() && !counts(grid, cell)) return 0;
  // Sides under 100 km are as good as straight; longer ones bend, and their pieces do not.
  constexpr double kStraight = 2.5e-4, kLarge = 1e-2;
  const double coarse = polygonArea(grid, cell, 1);
  const double area = coarse < kStraight ? coarse : polygonArea(grid, cell, coarse < kLarge ? 8 : 64);
  return std::isfinite(area) ? kSquare * area : 0;
}

double shareInside(const Grid& grid, std::uint32_t cell, const base::GeoBox& box) {
  if (isGeographic(grid)) {
    const int row = grid.row(cell);
    const double step = stepOfRow(grid, row), width = std::abs(step);
    const double west = planeX(grid, row, grid.column(cell) + (step < 0 ? 1 : 0));
    const Interval all = rowInterval(grid, row);
    const Interval inside{std::max(all.low, box.south), std::min(all.high, box.north)};
    if (inside.high <= inside.low) return 0;
    const double longitudes = std::clamp(sharedLongitudes(west, width, box) / width, 0.0, 1.0);
    return longitudes * zoneArea(inside) / zoneArea(all);
  }
  if (!counts(grid, cell)) return 0;
  const auto cap = capOf(grid, cell);
  if (cap && relationOf(*cap, box) != Relation::Across)
    return relationOf(*cap, box) == Relation::Inside ? 1 : 0;
  constexpr int kSamples = 8;
  const auto along = [](int i) { return (i + 0.5) / kSamples; };
  double found = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int k = 0; k < kSamples; ++k) found += weightIn(box, pointIn(grid, cell, along(i), along(k)));
  if (found > kSamples || !cap) return found / (kSamples * kSamples);
  // A box much smaller than the cell: the samples are taken in the box.
  const auto part = partWithin(box, *cap);
  if (!part) return 0;
  double shared = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double low = part->south + part->height() * i / kSamples, high = low + part->height() / kSamples;
    for (int k = 0; k < kSamples; ++k)
      if (holds(grid, cell,
                {base::wrappedLongitude(part->west + along(k) * part->width()), 0.5 * (low + high)}))
        shared += zoneArea({low, high}) * part->width() / kSamples;
  }
  return std::clamp(shared * kEarthRadiusMeters * kEarthRadiusMeters / cellAreaSquareMeters(grid, cell), 0.0,
                    1.0);
}

}  // namespace cloudgen::field
