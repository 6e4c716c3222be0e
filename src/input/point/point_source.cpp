// SPDX-License-Identifier: Apache-2.0
#include "input/point/point_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/frame.hpp"

namespace cloudgen::input {
namespace {

using field::GeoPoint;

constexpr double kRadians = std::numbers::pi / 180.0, kMetersPerDegree = field::kEarthRadiusMeters * kRadians,
                 kMostCells = 200'000;

/// The shortest span of longitudes that holds all points: its western end and its width.
std::pair<double, double> longitudesOf(std::span<const GeoPoint> points) {
  std::vector<double> sorted;
  for (const GeoPoint& point : points) sorted.push_back(base::wrappedLongitude(point.longitudeDegrees));
  std::sort(sorted.begin(), sorted.end());
  double west = sorted.front(), widestGap = sorted.front() + 360.0 - sorted.back();
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > widestGap) {
      widestGap = sorted[i] - sorted[i - 1];
      west = sorted[i];
    }
  return {west, 360.0 - widestGap};
}

}  // namespace

double distanceMeters(const GeoPoint& a, const GeoPoint& b) {
  const double south = std::sin(0.5 * (a.latitudeDegrees - b.latitudeDegrees) * kRadians),
               east = std::sin(0.5 * (a.longitudeDegrees - b.longitudeDegrees) * kRadians);
  const double chord = south * south + std::cos(a.latitudeDegrees * kRadians) *
                                           std::cos(b.latitudeDegrees * kRadians) * east * east;
  return 2.0 * field::kEarthRadiusMeters * std::asin(std::sqrt(std::clamp(chord, 0.0, 1.0)));
}

field::Grid latticeOver(std::span<const GeoPoint> points, double cellMeters) {
  const auto [west, width] = longitudesOf(points);
  double south = 90, north = -90;
  for (const GeoPoint& point : points) {
    south = std::min(south, point.latitudeDegrees);
    north = std::max(north, point.latitudeDegrees);
  }
  const double middle = 0.5 * (south + north);
  const double shrink = std::max(0.02, std::cos(middle * kRadians));
  field::Grid grid;
  for (double cell = cellMeters;; cell *= 1.25) {
    grid.stepY = std::min(cell / kMetersPerDegree, 5.0);
    grid.stepX = std::min(cell / kMetersPerDegree / shrink, 90.0);
    const double columns = std::round(width / grid.stepX) + 1, around = std::floor(360.0 / grid.stepX);
    grid.wrapsLongitude = columns >= around;
    grid.columns = static_cast<int>(std::clamp(columns, 1.0, around));
    grid.rows = static_cast<int>(std::round((north - south) / grid.stepY)) + 1;
    if (static_cast<double>(grid.columns) * grid.rows <= kMostCells) break;
  }
  if (grid.wrapsLongitude) grid.stepX = 360.0 / grid.columns;
  grid.firstX = west + 0.5 * width - 0.5 * (grid.columns - 1) * grid.stepX;
  grid.firstY = middle - 0.5 * (grid.rows - 1) * grid.stepY;
  // Half a cell beyond a pole is nowhere: the lattice then ends at it.
  const double lowest = std::max(-90.0, grid.firstY - 0.5 * grid.stepY),
               highest = std::min(90.0, grid.firstY + (grid.rows - 0.5) * grid.stepY);
  grid.stepY = (highest - lowest) / grid.rows;
  grid.firstY = lowest + 0.5 * grid.stepY;
  return grid;
}

double medianSpacingMeters(std::span<const GeoPoint> points) {
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a].latitudeDegrees < points[b].latitudeDegrees;
  });
  // Southwards and northwards from each point until latitude alone is farther than the nearest found.
  constexpr std::size_t kMostLooks = 2000;
  std::vector<double> nearest;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const GeoPoint& here = points[order[i]];
    double least = 1e9;
    const auto farther = [&](std::size_t j) {
      const GeoPoint& there = points[order[j]];
      if (std::abs(there.latitudeDegrees - here.latitudeDegrees) * kMetersPerDegree > least) return true;
      const double meters = distanceMeters(here, there);
      if (meters > 100) least = std::min(least, meters);
      return false;
    };
    for (std::size_t j = i; j-- > 0 && i - j < kMostLooks;)
      if (farther(j)) break;
    for (std::size_t j = i + 1; j < order.size() && j - i < kMostLooks; ++j)
      if (farther(j)) break;
    if (least < 1e9) nearest.push_back(least);
  }
  if (nearest.empty()) return 0;
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2),
                   nearest.end());
  return nearest[nearest.size() / 2];
}

std::vector<std::vector<Near>> pointsNear(const field::Grid& grid, std::span<const GeoPoint> points,
                                          double reachMeters) {
  std::vector<std::vector<Near>> near(grid.size());
  const int rowsAbout = static_cast<int>(reachMeters / (grid.stepY * kMetersPerDegree)) + 1;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const GeoPoint& point = points[i];
    const double x = (point.longitudeDegrees - grid.firstX) / grid.stepX,
                 y = (point.latitudeDegrees - grid.firstY) / grid.stepY;
    const double turn = 360.0 / grid.stepX;
    const int own = std::clamp(static_cast<int>(std::lround(y)), 0, grid.rows - 1);
    for (int row = std::max(0, own - rowsAbout); row <= std::min(grid.rows - 1, own + rowsAbout); ++row) {
      const double latitude = std::min(89.9, std::abs(grid.firstY + row * grid.stepY) + 0.5 * grid.stepY);
      const double about = reachMeters / (grid.stepX * kMetersPerDegree * std::cos(latitude * kRadians)) + 1;
      // Columns counted from the point, once around at most, as often as the turn brings them into the grid.
      for (const double shift : {-turn, 0.0, turn}) {
        const int first = std::max(0, static_cast<int>(std::ceil(std::max(x + shift - about, -1.0)))),
                  last = std::min(grid.columns - 1,
                                  static_cast<int>(std::floor(std::min(x + shift + about, 1e6))));
        for (int column = first; column <= last; ++column) {
          const std::uint32_t cell = grid.index(column, row);
          const double meters = distanceMeters(point, field::centerOf(grid, cell));
          const bool within = row == own && std::abs(x + shift - column) <= 0.5;
          const bool known = !near[cell].empty() && near[cell].back().point == i;
          if ((meters <= reachMeters || within) && !known) near[cell].push_back({i, meters});
        }
      }
    }
  }
  for (std::vector<Near>& cell : near)
    std::sort(cell.begin(), cell.end(), [](const Near& a, const Near& b) {
      return std::tie(a.meters, a.point) < std::tie(b.meters, b.point);
    });
  return near;
}

PointSource::PointSource(field::SourceInfo info, field::Grid grid, std::vector<field::StatedLayer> layers,
                         std::vector<float> surface)
    : info_(std::move(info)),
      grid_(std::move(grid)),
      layers_(std::move(layers)),
      surface_(std::move(surface)) {}

field::Surface PointSource::surface(std::span<const std::uint32_t> cells) const {
  field::Surface surface;
  for (const std::uint32_t cell : cells) surface.heightMeters.push_back(surface_[cell]);
  return surface;
}

void PointSource::visitLayers(std::span<const std::uint32_t> cells,
                              const std::function<void(const field::StatedLayer&)>& visit) const {
  for (const std::uint32_t cell : cells) {
    auto layer =
        std::lower_bound(layers_.begin(), layers_.end(), cell,
                         [](const field::StatedLayer& a, std::uint32_t wanted) { return a.cell < wanted; });
    for (; layer != layers_.end() && layer->cell == cell; ++layer) visit(*layer);
  }
}

}  // namespace cloudgen::input
