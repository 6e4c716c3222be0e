// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "field/curvilinear.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Grows with places that follow one another: longitudes are told as on a walk, without jumps.
struct Walk {
  double west = 1e300, east = -1e300, south = 90, north = -90, first = 0, longitude = 0;
  bool begun = false, broken = false;

  /// Goes on from a place that does not count itself.
  void jumpTo(const GeoPoint& place) {
    longitude = place.longitudeDegrees;
    begun = true;
  }

  void add(const GeoPoint& place) {
    if (!isPlace(place)) {
      broken = true;
      return;
    }
    longitude = begun ? longitude + base::wrappedLongitude(place.longitudeDegrees - longitude)
                      : place.longitudeDegrees;
    if (!begun) first = longitude;
    begun = true;
    west = std::min(west, longitude);
    east = std::max(east, longitude);
    south = std::min(south, place.latitudeDegrees);
    north = std::max(north, place.latitudeDegrees);
  }
};

/// Place at lattice coordinates: (column + u, row + v).
GeoPoint placeAt(const Grid& grid, int column, double u, int row, double v) {
  return pointIn(grid, cellAt(grid, column, row), u, v);
}

/// Once around the border, four steps a cell.
Walk walkAround(const Grid& grid) {
  constexpr int kSteps = 4;
  Walk walk;
  const int lastRow = grid.rows - 1;
  const auto along = [](int step) { return static_cast<double>(step) / kSteps; };
  for (int column = 0; column < columnsOf(grid, 0); ++column)
    for (int step = 0; step < kSteps; ++step) walk.add(placeAt(grid, column, along(step), 0, 0));
  for (int row = 0; row <= lastRow; ++row)
    for (int step = 0; step < kSteps; ++step)
      walk.add(placeAt(grid, columnsOf(grid, row) - 1, 1, row, along(step)));
  for (int column = columnsOf(grid, lastRow) - 1; column >= 0; --column)
    for (int step = kSteps; step > 0; --step) walk.add(placeAt(grid, column, along(step), lastRow, 1));
  for (int row = lastRow; row >= 0; --row)
    for (int step = kSteps; step >= 0; --step) walk.add(placeAt(grid, 0, 0, row, along(step)));
  return walk;
}

/// Corners of a cell that are on the Earth.
void addCorners(const Grid& grid, int column, int row, Walk& walk) {
  for (const double v : {0.0, 1.0})
    for (const double u : {0.0, 1.0}) walk.add(placeAt(grid, column, u, row, v));
}

/// To and fro through all cells, for grids around the Earth.
Walk walkThrough(const Grid& grid) {
  Walk walk;
  for (int row = 0; row < grid.rows; ++row) {
    const int columns = columnsOf(grid, row);
    for (int i = 0; i < columns; ++i) addCorners(grid, row % 2 == 0 ? i : columns - 1 - i, row, walk);
  }
  return walk;
}

/// Along the first and the last cells on the Earth of all rows and columns: the limb of a disc.
Walk walkAlongLimb(const Grid& grid) {
  Walk walk;
  const auto onEarth = [&](int column, int row) {
    return isPlace(centerOf(grid, cellAt(grid, column, row)));
  };
  // All longitudes are told from the middle of the disc.
  const GeoPoint middle = centerOf(grid, cellAt(grid, columnsOf(grid, grid.rows / 2) / 2, grid.rows / 2));
  const auto look = [&](int column, int row) {
    if (isPlace(middle)) walk.jumpTo(middle);
    addCorners(grid, column, row, walk);
  };
  for (int row = 0; row < grid.rows; ++row) {
    int first = 0, last = columnsOf(grid, row) - 1;
    while (first <= last && !onEarth(first, row)) ++first;
    while (last > first && !onEarth(last, row)) --last;
    if (first > last) continue;
    look(first, row);
    look(last, row);
  }
  if (!grid.reducedRows.empty()) return walk;
  for (int column = 0; column < grid.columns; ++column) {
    int first = 0, last = grid.rows - 1;
    while (first <= last && !onEarth(column, first)) ++first;
    while (last > first && !onEarth(column, last)) --last;
    if (first > last) continue;
    look(column, first);
    look(column, last);
  }
  return walk;
}

struct Poles {
  bool north = false, south = false;
};

/// Which poles lie inside. The border of a curvilinear grid winds around the one that does.
Poles polesInside(const Grid& grid, const Walk& walk) {
  if (!grid.centers.empty() && !grid.wrapsLongitude) {
    if (walk.broken || std::abs(walk.longitude - walk.first) < 180) return {};
    const GeoPoint middle = centerOf(grid, grid.index(grid.columns / 2, grid.rows / 2));
    const bool north = middle.latitudeDegrees > 0.5 * (walk.south + walk.north);
    return {north, !north};
  }
  const CellFinder finder(grid);
  return {finder.at({0, 90}).has_value(), finder.at({0, -90}).has_value()};
}

base::GeoBox boxOf(const Walk& walk, const Poles& poles) {
  base::GeoBox box{-180, poles.south ? -90 : walk.south, 180, poles.north ? 90 : walk.north};
  if (poles.north || poles.south || walk.east - walk.west >= 360 - kSameDegrees) return box;
  box.west = base::wrappedLongitude(walk.west);
  box.east = base::wrappedLongitude(walk.east);
  if (box.east == -180) box.east = 180;
  return box;
}

base::GeoBox geographicExtent(const Grid& grid) {
  Interval latitudes{90, -90}, longitudes{0, 0};
  bool begun = false;
  for (int row = 0; row < grid.rows; ++row) {
    const int columns = columnsOf(grid, row);
    if (columns == 0) continue;
    const Interval here = rowInterval(grid, row);
    latitudes = {std::min(latitudes.low, here.low), std::max(latitudes.high, here.high)};
    const double one = planeX(grid, row, 0), other = planeX(grid, row, columns);
    double west = std::min(one, other), east = std::max(one, other);
    // Rows may be counted from elsewhere: -30 degrees in one, 330 in another.
    const double turn = begun ? 360 * std::round((longitudes.low - west) / 360) : 0;
    west += turn, east += turn;
    longitudes = begun ? Interval{std::min(longitudes.low, west), std::max(longitudes.high, east)}
                       : Interval{west, east};
    begun = true;
  }
  base::GeoBox box{-180, latitudes.low, 180, latitudes.high};
  if (grid.wrapsLongitude || longitudes.high - longitudes.low >= 360.0 - kSameDegrees) return box;
  box.west = base::wrappedLongitude(longitudes.low);
  box.east = base::wrappedLongitude(box.west + (longitudes.high - longitudes.low));
  if (box.east == -180) box.east = 180;
  return box;
}

}  // namespace

base::GeoBox extent(const Grid& grid) {
  if (isGeographic(grid)) return geographicExtent(grid);
  if (!grid.southCrs.empty()) return {-180, -90, 180, 90};
  const Walk border = grid.wrapsLongitude ? walkThrough(grid) : walkAround(grid);
  const Poles poles = polesInside(grid, border);
  return boxOf(border.broken && !grid.wrapsLongitude ? walkAlongLimb(grid) : border, poles);
}

}  // namespace cloudgen::field
