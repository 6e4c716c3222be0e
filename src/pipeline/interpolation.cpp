// SPDX-License-Identifier: Apache-2.0
#include "pipeline/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace cloudgen::pipeline {
namespace {

/// From -0.5..0.5 in the cell to how far one has gone towards the next centre: nothing in the middle half.
double pastTheMiddle(double t) { return std::copysign(2 * std::max(0.0, std::abs(t) - 0.25), t); }

double tent(double distance) { return std::max(0.0, 1 - std::abs(distance)); }

/// Where the water of a layer gathers: thin ice that trails far above or below it is not what goes on next
/// door.
double gatheredMeters(const field::Layer& layer) { return layer.upperMeters - layer.lowerMeters; }

double sharedMeters(const field::Layer& a, const field::Layer& b) {
  return std::min(a.upperMeters, b.upperMeters) - std::max(a.lowerMeters, b.lowerMeters);
}

/// How many cells `to` lies from `from`, along its rows and columns.
std::pair<double, double> cellsAway(const field::Grid& grid, std::uint32_t from, std::uint32_t to) {
  if (grid.reducedRows.empty()) {
    int columns = grid.column(to) - grid.column(from);
    const int rows = grid.row(to) - grid.row(from);
    if (grid.wrapsLongitude && std::abs(columns) > grid.columns / 2)
      columns += columns > 0 ? -grid.columns : grid.columns;
    if (std::abs(columns) <= 1 && std::abs(rows) <= 1) return {columns, rows};
  }
  const field::GeoPoint a = field::centerOf(grid, from), b = field::centerOf(grid, to);
  constexpr double kDegree = std::numbers::pi / 180;
  const double east = base::wrappedLongitude(b.longitudeDegrees - a.longitudeDegrees) * kDegree *
                      field::kEarthRadiusMeters * std::cos(a.latitudeDegrees * kDegree),
               north = (b.latitudeDegrees - a.latitudeDegrees) * kDegree * field::kEarthRadiusMeters;
  const double angle = field::axisAngle(grid, from);
  const glm::dvec2 sides = field::cellSidesMeters(grid, from);
  const bool southward = field::pointIn(grid, from, 0.5, 0.9).latitudeDegrees < a.latitudeDegrees;
  const double along = east * std::cos(angle) + north * std::sin(angle),
               across = north * std::cos(angle) - east * std::sin(angle);
  return {along / sides.x, (southward ? -across : across) / sides.y};
}

}  // namespace

double LayerAround::fractionAt(double u, double v) const {
  // Geometric means: towards clear air cloud fades out within the cell, not at its border.
  constexpr double kLeast = 0.02;
  double weight = tent(u - 0.5) * tent(v - 0.5),
         sum = weight * std::log(std::max<double>(kLeast, own_->fraction));
  for (const Neighbour& next : neighbours_) {
    const double share = tent(u - 0.5 - next.columnsAway) * tent(v - 0.5 - next.rowsAway);
    weight += share;
    sum += share * std::log(std::max<double>(kLeast, next.layer ? next.layer->fraction : 0));
  }
  return std::exp(sum / weight);
}

LayerAtPlace LayerAround::at(double u, double v) const {
  LayerAtPlace here;
  here.fraction = std::clamp(fractionAt(u, v), 0.0, 1.0);
  const double x = pastTheMiddle(u - 0.5), y = pastTheMiddle(v - 0.5);
  double weight = 0;
  const auto mix = [&](const field::Layer& layer, double share) {
    weight += share;
    here.lowerMeters += share * layer.lowerMeters;
    here.upperMeters += share * layer.upperMeters;
    // A thin layer beside a thick one stays thin: within twice its own all the way to the border.
    const double own = own_->opticalDepth();
    here.opticalDepth += share * std::clamp<double>(layer.opticalDepth(), 0.5 * own, 2 * own);
  };
  mix(*own_, tent(x) * tent(y));
  for (const Neighbour& next : neighbours_)
    if (next.layer) mix(*next.layer, tent(x - next.columnsAway) * tent(y - next.rowsAway));
  here.lowerMeters /= weight, here.upperMeters /= weight, here.opticalDepth /= weight;
  return here;
}

glm::dvec2 LayerAround::awayFromClearSides(glm::dvec2 place, glm::dvec2 reach) const {
  constexpr double kFurthest = 0.4, kAside = 0.25;
  reach = glm::min(reach, glm::dvec2(kFurthest));
  for (const Neighbour& next : neighbours_) {
    if (next.layer) continue;
    if (std::abs(next.rowsAway) < kAside)
      place.x = next.columnsAway > 0 ? std::min(place.x, 1 - reach.x) : std::max(place.x, reach.x);
    if (std::abs(next.columnsAway) < kAside)
      place.y = next.rowsAway > 0 ? std::min(place.y, 1 - reach.y) : std::max(place.y, reach.y);
  }
  return place;
}

LayersByCell::LayersByCell(const field::Grid& grid, std::span<const field::Layer> layers) : grid_(grid) {
  for (const field::Layer& layer : layers) byCell_.push_back(&layer);
  std::sort(byCell_.begin(), byCell_.end(), [](const field::Layer* a, const field::Layer* b) {
    return std::pair(a->cell, a->ordinal) < std::pair(b->cell, b->ordinal);
  });
}

LayerAround LayersByCell::of(const field::Layer& layer) const {
  LayerAround around;
  around.own_ = &layer;
  for (const std::uint32_t cell : field::neighbours(grid_, layer.cell)) {
    LayerAround::Neighbour next;
    std::tie(next.columnsAway, next.rowsAway) = cellsAway(grid_, layer.cell, cell);
    const auto first = std::lower_bound(byCell_.begin(), byCell_.end(), cell,
                                        [](const field::Layer* a, std::uint32_t b) { return a->cell < b; });
    double most = 0;
    for (auto it = first; it != byCell_.end() && (*it)->cell == cell; ++it) {
      const double overlap = sharedMeters(layer, **it);
      if (overlap <= 0.5 * std::min(gatheredMeters(layer), gatheredMeters(**it)) || overlap <= most) continue;
      most = overlap;
      next.layer = *it;
    }
    around.neighbours_.push_back(next);
  }
  return around;
}

}  // namespace cloudgen::pipeline
