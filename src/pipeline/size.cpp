// SPDX-License-Identifier: Apache-2.0
#include "pipeline/size.hpp"

#include <algorithm>
#include <cmath>

#include "shape/generate.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr double kSmallest = 0.45, kLargest = 1.8, kSlope = 2.4;  // n(w) ~ w^-2.4 is N(A) ~ A^-1.7

/// Relative width by inversion of the cut power law; u in 0..1.
double relativeWidth(double u) {
  const double a = std::pow(kSmallest, 1 - kSlope), b = std::pow(kLargest, 1 - kSlope);
  return std::pow(a + u * (b - a), 1 / (1 - kSlope));
}

/// Root of the mean square of relativeWidth: what turns it into a width with mean footprint 1.
double meanSquareRoot() {
  const auto integral = [](double power) {
    return (std::pow(kLargest, power) - std::pow(kSmallest, power)) / power;
  };
  return std::sqrt(integral(3 - kSlope) / integral(1 - kSlope));
}

}  // namespace

void sizeClouds(const Options& options, const Generalisation& general, field::CloudTable& table) {
  const double normal = meanSquareRoot();
  for (field::Cloud& cloud : table.clouds) {
    const field::Layer& layer = table.layers[cloud.layer];
    const shape::Recipe& recipe = options.recipes.of(layer.genus);
    base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudSize,
                              (static_cast<std::uint64_t>(layer.ordinal) << 40) | cloud.ordinal);
    const double meanWidth = layer.cloudCount > 0 ? countedWidthMeters(recipe, cloud.coversSquareMeters)
                                                  : meanWidthMeters(general, recipe, layer.depthMeters());
    double width = meanWidth;
    double depth = layer.depthMeters();
    if (!recipe.sheet) {
      const double relative = relativeWidth(stream.uniform()) / normal;
      width *= relative;
      if (recipe.form == shape::Form::Heap)
        depth *= std::clamp(0.35 + 0.45 * relative + 0.12 * stream.gaussian(), 0.25, 1.0);
    }
    cloud.widthMeters = static_cast<float>(width);
    cloud.depthMeters = static_cast<float>(depth);
    cloud.baseMeters = layer.baseMeters;
    // What the layer owes this cloud's ground, spread over the mean footprint: a smaller box changes nothing.
    cloud.opticalDepth = static_cast<float>(layer.opticalDepth() * cloud.coversSquareMeters /
                                            shape::footprintSquareMeters(meanWidth));
  }
}

}  // namespace cloudgen::pipeline
