// SPDX-License-Identifier: Apache-2.0
#include "pipeline/misfit.hpp"

#include <cmath>

namespace cloudgen::pipeline {
namespace {

/// Weight of the cover of all layers together, beside that of each.
constexpr double kWeightOfAll = 0.5;
/// Weight of the mean error of the whole sky, squared, beside the mean of the squared errors of its cells:
/// errors of cells that all have one sign make a bias.
constexpr double kWeightOfMean = 20, kToleratedMean = 0.01;
/// Weight of what optical depth lacks or is too much, and of what strays in, as a squared error of cover.
constexpr double kWeightOfDepth = 0.6, kWeightOfStray = 0.2;
/// Weight of a full sheet: a gap in it is seen sooner than one among many.
constexpr double kWeightOfFull = 5.5;

double squared(double x) { return x * x; }

/// Low, middle or high, by its base.
std::size_t rangeOf(double baseMeters) {
  constexpr double kMiddleFrom = 2000, kHighFrom = 6000;
  return baseMeters < kMiddleFrom ? 0 : baseMeters < kHighFrom ? 1 : 2;
}

}  // namespace

Misfit::Misfit(const Canvas& canvas, std::span<const field::Layer> layers)
    : canvas_(canvas), layers_(layers), wantedOfAll_(canvas.cells().size(), 0) {
  for (const PaintedCell& cell : canvas.cells()) pixels_ += cell.pixels;
}

double Misfit::changeBy(const Stroke& stroke) const {
  double change = changeOfMeans(changeOfSurplus(stroke));
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

/// Optical depth counts as a share of the cell's. What strays in takes base and top of a cell with it as soon
/// as it is more than a twentieth.
double Misfit::changeOfDepth(const PaintedCell& cell, const PaintedLayer& layer, double opticalDepth) const {
  const double whole = cell.wantedOpticalDepth;
  if (!judgesTheWholeSky_ || !(whole > 0)) return 0;
  const bool astray = layer.wantedOpticalDepth == 0;
  const auto harm = [&](double depth) {
    const double error = squared((depth - layer.wantedOpticalDepth) / whole);
    return astray ? kWeightOfStray * error / (error + squared(field::kBorderShare))
                  : kWeightOfDepth * error / (error + 1);
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

void Misfit::note(const Stroke& stroke) {
  const Surplus change = changeOfSurplus(stroke);
  surplus_.ofAll += change.ofAll;
  for (std::size_t g = 0; g < change.ofGenus.size(); ++g) surplus_.ofGenus[g] += change.ofGenus[g];
  for (std::size_t r = 0; r < change.ofRange.size(); ++r) surplus_.ofRange[r] += change.ofRange[r];
}

void Misfit::restart() {
  surplus_ = {};
  for (const double wanted : wantedOfAll_) surplus_.ofAll -= wanted;
  for (const PaintedLayer& layer : canvas_.layers())
    if (layer.covers && layer.wantedCover > 0) {
      surplus_.ofGenus[static_cast<std::size_t>(layers_[layer.layer].genus)] -= layer.wantedCover;
      surplus_.ofRange[rangeOf(layer.baseMeters)] -= layer.wantedCover;
    }
}

}  // namespace cloudgen::pipeline
