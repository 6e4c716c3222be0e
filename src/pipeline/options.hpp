// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "base/frame.hpp"
#include "field/source.hpp"
#include "pipeline/recipes.hpp"

namespace cloudgen::pipeline {

/// What the user may choose of a build.
struct Options {
  std::optional<base::GeoBox> box;  ///< nothing: the whole grid
  std::uint64_t seed = 1;
  std::uint64_t maxPuffs = 200'000;                     ///< drawn puffs, all clouds together
  std::optional<std::pair<double, double>> sunDegrees;  ///< azimuth, elevation; nothing: from time and place
  RecipeBook recipes;
  const field::Source* typing = nullptr;  ///< cloud typing beside a moisture model; outlives the run
};

}  // namespace cloudgen::pipeline
