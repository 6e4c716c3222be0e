// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "shape/generate.hpp"

namespace cloudgen::test {

/// A cloud of a usual size of its genus; a piece of a layer is `layerAspect` times as wide as deep.
inline shape::ShapeRequest usualCloud(const shape::Recipe& recipe, int puffs, double layerAspect) {
  shape::ShapeRequest wanted;
  wanted.depthMeters = std::sqrt(recipe.thicknessMeters.low * recipe.thicknessMeters.high);
  wanted.widthMeters = wanted.depthMeters * (recipe.form == shape::Form::Heap    ? 0.9
                                             : recipe.form == shape::Form::Tower ? 1.9
                                                                                 : layerAspect);
  wanted.opticalDepth = recipe.opticalDepth;
  wanted.puffs = puffs;
  return wanted;
}

}  // namespace cloudgen::test
