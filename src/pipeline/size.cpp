// SPDX-License-Identifier: Apache-2.0
#include "pipeline/size.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/archetype.hpp"

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

CloudSize sizeOf(const field::Layer& layer, std::uint32_t ordinal, double layerDepthMeters,
                 double meanWidthMeters, const Options& options) {
  static const double kNormal = meanSquareRoot();
  const shape::Recipe& recipe = options.recipes.of(layer);
  CloudSize size{meanWidthMeters, layerDepthMeters};
  if (!recipe.sheet) {
    base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudSize, itemOf(layer, ordinal));
    const double relative = relativeWidth(stream.uniform()) / kNormal;
    // A form of its own keeps its proportions, and so the width that goes with the layer's depth.
    const bool ownForm = recipe.form == shape::Form::File;
    size.widthMeters *= ownForm ? std::clamp(relative, 0.85, 1.15) : relative;
    if (recipe.form == shape::Form::Heap) {
      const double share = std::clamp(0.35 + 0.45 * relative + 0.12 * stream.gaussian(), 0.25, 1.0);
      // One that is enlarged stands for several, of which the deepest reach the layer's top.
      const double enlargement =
          std::max(1.0, meanWidthMeters / naturalWidthMeters(recipe, layerDepthMeters));
      size.depthMeters *= 1 - (1 - share) / enlargement;
    }
  }
  size.widthMeters = drawnWidthMeters(size.depthMeters, size.widthMeters);
  return size;
}

}  // namespace cloudgen::pipeline
