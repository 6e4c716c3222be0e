// SPDX-License-Identifier: Apache-2.0
#include "pipeline/misfit.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::pipeline {
namespace {

/// Weight of the cover of all layers together, beside that of each.
constexpr double kWeightOfAll = 0.5;
/// Weight of the mean error of the whole sky, squared, beside the mean of the squared errors of its cells:
/// errors of cells that all have one sign make a bias.
constexpr double kWeightOfMean = 20, kToleratedMean = 0.01;
/// Weight of what optical depth lacks or is too much, and of what strays in, as a squared error of cover.
constexpr double kWeightOfDepth = 0.6, kWeightOfStray = 0.1;
/// Weight of a full sheet: a gap in it is seen sooner than one among many.
constexpr double kWeightOfFull = 5.5;
/// Base and top: an error of so many metres counts as one of the whole cover.
constexpr double kMetersAsCover = 1700;

double squared(double x) { return x * x; }

/// Heights between which something is spread evenly that has a part's mean and variance of height.
struct Extent {
  float baseMeters, topMeters;
};
Extent extentOf(const Stroke::Part& part, const Stroke& stroke) {
  const double half = std::sqrt(3 * std::max(part.square - squared(part.mean), 0.0));
  return {static_cast<float>(stroke.baseMeters + stroke.widthMeters * (part.mean - half)),
          static_cast<float>(stroke.baseMeters + stroke.widthMeters * (part.mean + half))};
}

}  // namespace

Misfit::Misfit(const Canvas& canvas, std::span<const field::Layer> layers)
    : canvas_(canvas), layers_(layers), wantedOfAll_(canvas.cells().size(), 0), heights_(canvas, layers) {
  for (const PaintedCell& cell : canvas.cells()) pixels_ += cell.pixels;
}

double Misfit::changeBy(const Stroke& stroke) const {
  double change = changeOfMeans(changeOfSurplus(stroke)) + changeOfHeights(stroke);
  for (const Stroke::Touched& touched : stroke.touched) {
    const PaintedCell& cell = canvas_.cells()[touched.cell];
    const PaintedLayer& layer = canvas_.layers()[touched.layer];
    const double wanted = wantedOfAll_[touched.cell];
    const auto weightOf = [&](double pixels) {
      return pixels >= kFullCover * cell.pixels ? kWeightOfFull : 1;
    };
    double here =
        kWeightOfAll * weightOf(wanted) *
        (squared(cell.covered + touched.coveredByAnyChange - wanted) - squared(cell.covered - wanted));
    if (layer.covers)
      here +=
          weightOf(layer.wantedCover) * (squared(layer.covered + touched.coveredChange - layer.wantedCover) -
                                         squared(layer.covered - layer.wantedCover));
    change += here / cell.pixels;
    change += changeOfDepth(cell, layer, touched.opticalDepth);
  }
  return change;
}

/// Optical depth counts as a share of the cell's.
double Misfit::changeOfDepth(const PaintedCell& cell, const PaintedLayer& layer, double opticalDepth) const {
  const double whole = cell.wantedOpticalDepth;
  if (!judgesTheWholeSky_ || !(whole > 0)) return 0;
  const bool astray = layer.wantedOpticalDepth == 0;
  const auto harm = [&](double depth) {
    const double error = squared((depth - layer.wantedOpticalDepth) / whole);
    return (astray ? kWeightOfStray : kWeightOfDepth) * error / (error + 1);
  };
  return cell.pixels * (harm(layer.opticalDepth + opticalDepth) - harm(layer.opticalDepth));
}

/// What stands astray counts for the genus that it strays from.
Misfit::Surplus Misfit::changeOfSurplus(const Stroke& stroke) {
  Surplus change;
  for (const Stroke::Touched& touched : stroke.touched) {
    change.ofAll += touched.coveredByAnyChange;
    change.ofGenus[static_cast<std::size_t>(stroke.genus)] += touched.coveredChange;
    change.ofRange[rangeOf(stroke.baseMeters)] += touched.coveredChange;
  }
  return change;
}

double Misfit::changeOfMeans(const Surplus& change) const {
  if (!judgesTheWholeSky_) return 0;
  // Squared up to what is tolerated, no steeper beyond: or one genus that cannot but cover too much would be
  // driven out where it lacks.
  const auto harm = [&](double surplus) {
    const double tolerated = kToleratedMean * pixels_, error = std::abs(surplus);
    return error < tolerated ? squared(error) : tolerated * (2 * error - tolerated);
  };
  const auto changeOf = [&](const auto& now, const auto& by) {
    double sum = 0;
    for (std::size_t i = 0; i < now.size(); ++i) sum += harm(now[i] + by[i]) - harm(now[i]);
    return sum;
  };
  const double sum = kWeightOfAll * (harm(surplus_.ofAll + change.ofAll) - harm(surplus_.ofAll)) +
                     0.5 * changeOf(surplus_.ofGenus, change.ofGenus) +
                     0.5 * changeOf(surplus_.ofRange, change.ofRange);
  return kWeightOfMean * sum / pixels_;
}

double Misfit::changeOfHeights(const Stroke& stroke) const {
  double change = 0;
  for (const Stroke::Part& part : stroke.parts) change += changeOfHeights(stroke, part, part.opticalDepth);
  return change;
}

double Misfit::changeOfHeights(const Stroke& stroke, const Stroke::Part& part, double opticalDepth) const {
  if (!judgesTheWholeSky_) return 0;
  const Extent extent = extentOf(part, stroke);
  return canvas_.cells()[part.cell].pixels / squared(kMetersAsCover) *
         heights_.changeBy(part.cell, extent.baseMeters, extent.topMeters, opticalDepth);
}

double Misfit::changeAsGiven(const Stroke& taken, std::uint32_t layer) const {
  double change = 0;
  for (const Stroke::Touched& touched : taken.touched) {
    if (touched.layer != layer) continue;
    change += changeOfDepth(canvas_.cells()[touched.cell], canvas_.layers()[layer], -touched.opticalDepth);
    for (const Stroke::Part& part : taken.parts)
      if (part.cell == touched.cell) change += changeOfHeights(taken, part, -touched.opticalDepth);
  }
  return change;
}

void Misfit::note(const Stroke& stroke) {
  for (const Stroke::Part& part : stroke.parts) {
    const Extent extent = extentOf(part, stroke);
    heights_.add(part.cell, extent.baseMeters, extent.topMeters, part.opticalDepth);
  }
  const Surplus change = changeOfSurplus(stroke);
  surplus_.ofAll += change.ofAll;
  for (std::size_t g = 0; g < change.ofGenus.size(); ++g) surplus_.ofGenus[g] += change.ofGenus[g];
  for (std::size_t r = 0; r < change.ofRange.size(); ++r) surplus_.ofRange[r] += change.ofRange[r];
}

void Misfit::restart() {
  surplus_ = {};
  heights_.clear();
  for (const double wanted : wantedOfAll_) surplus_.ofAll -= wanted;
  for (const PaintedLayer& layer : canvas_.layers())
    if (layer.covers && layer.wantedCover > 0) {
      surplus_.ofGenus[static_cast<std::size_t>(layers_[layer.layer].genus)] -= layer.wantedCover;
      surplus_.ofRange[rangeOf(layer.baseMeters)] -= layer.wantedCover;
    }
}

}  // namespace cloudgen::pipeline
