// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "field/source.hpp"

namespace cloudgen::input {

/// Great-circle distance in metres.
double distanceMeters(const field::GeoPoint& a, const field::GeoPoint& b);

/// A latitude-longitude lattice of about square cells (at the points' middle latitude) that holds all points;
/// one point is one cell around it. Where that takes more than 200,000 cells, the cells are wider. The
/// antimeridian and the poles may lie among the points.
field::Grid latticeOver(std::span<const field::GeoPoint> points, double cellMeters);

/// Median over the points of the distance to the nearest other point; 0 for fewer than two places.
double medianSpacingMeters(std::span<const field::GeoPoint> points);

/// For each cell of the lattice, the points within reach of its middle and their distances, nearest first; a
/// cell that a point lies in always has that point.
struct Near {
  std::uint32_t point = 0;
  double meters = 0;
};
std::vector<std::vector<Near>> pointsNear(const field::Grid& grid, std::span<const field::GeoPoint> points,
                                          double reachMeters);

/// Layers by cell, all decided when the input was opened.
class PointSource : public field::Source {
 public:
  /// `layers` by cell, upwards within a cell; `surface` one height a cell.
  PointSource(field::SourceInfo info, field::Grid grid, std::vector<field::StatedLayer> layers,
              std::vector<float> surface);

  const field::SourceInfo& info() const override { return info_; }
  const field::Grid& grid() const override { return grid_; }
  field::Telling telling() const override { return field::Telling::Layers; }
  void visitLevels(std::span<const std::uint32_t>,
                   const std::function<void(const field::Level&)>&) const override {}
  field::Surface surface(std::span<const std::uint32_t> cells) const override;
  void visitLayers(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::StatedLayer&)>& visit) const override;

 private:
  field::SourceInfo info_;
  field::Grid grid_;
  std::vector<field::StatedLayer> layers_;
  std::vector<float> surface_;
};

}  // namespace cloudgen::input
