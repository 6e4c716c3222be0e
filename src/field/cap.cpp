// SPDX-License-Identifier: Apache-2.0
#include "field/cap.hpp"

#include <algorithm>
#include <cmath>

#include "field/curvilinear.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Half the longitudes that a cap reaches over; 180 where it holds a pole.
double halfWidthOf(const Cap& cap) {
  if (std::abs(cap.center.latitudeDegrees) + cap.radiusDegrees >= 90) return 180;
  return std::asin(std::min(
             1.0, std::sin(cap.radiusDegrees * kDegree) / std::cos(cap.center.latitudeDegrees * kDegree))) /
         kDegree;
}

Interval latitudesOf(const Cap& cap) {
  return {std::max(-90.0, cap.center.latitudeDegrees - cap.radiusDegrees),
          std::min(90.0, cap.center.latitudeDegrees + cap.radiusDegrees)};
}

}  // namespace

Relation relationOf(const Cap& cap, const base::GeoBox& box) {
  const Interval latitudes = latitudesOf(cap);
  if (latitudes.high <= box.south + kSameDegrees || latitudes.low >= box.north - kSameDegrees)
    return Relation::Outside;
  const double half = halfWidthOf(cap);
  const double away = std::abs(base::wrappedLongitude(cap.center.longitudeDegrees - box.centerLongitude()));
  const double halfBox = 0.5 * box.width();
  if (away >= half + halfBox - kSameDegrees) return Relation::Outside;
  const bool within = latitudes.low >= box.south && latitudes.high <= box.north &&
                      (box.width() >= 360 || away + half <= halfBox);
  return within ? Relation::Inside : Relation::Across;
}

std::optional<base::GeoBox> partWithin(const base::GeoBox& box, const Cap& cap) {
  if (relationOf(cap, box) == Relation::Outside) return std::nullopt;
  const Interval latitudes = latitudesOf(cap);
  base::GeoBox part = box;
  part.south = std::max(box.south, latitudes.low);
  part.north = std::min(box.north, latitudes.high);
  const double half = halfWidthOf(cap);
  const double middle = base::wrappedLongitude(cap.center.longitudeDegrees - box.west - 0.5 * box.width());
  const double from = std::max(middle - half, -0.5 * box.width()),
               to = std::min(middle + half, 0.5 * box.width());
  // Wide ones may meet on the far side too: then nothing is cut off.
  if (!(to > from) || half + 0.5 * box.width() >= 180) return part;
  part.west = base::wrappedLongitude(box.west + 0.5 * box.width() + from);
  part.east = base::wrappedLongitude(box.west + 0.5 * box.width() + to);
  return part;
}

std::optional<Cap> capOf(const Grid& grid, std::uint32_t cell) {
  const GeoPoint center = centerOf(grid, cell);
  if (!isPlace(center)) return std::nullopt;
  const glm::dvec3 middle = vectorOf(center);
  double reach = 0;
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0}) {
      const GeoPoint corner = pointIn(grid, cell, u, v);
      if (!isPlace(corner)) return std::nullopt;
      reach = std::max(reach, angleBetween(middle, vectorOf(corner)));
    }
  // Corners are the furthest places, but for bent sides of large cells.
  return Cap{center, reach / kDegree * (1.01 + reach)};
}

bool holds(const Grid& grid, std::uint32_t cell, const GeoPoint& place) {
  if (!grid.centers.empty()) return quadHolds(curvilinearCorners(grid, cell), vectorOf(place));
  const int half = grid.row(cell) / latticeRows(grid);
  return latticeCellOfHalf(grid, half, place) == cell;
}

}  // namespace cloudgen::field
