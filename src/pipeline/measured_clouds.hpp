// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tuple>

#include "pipeline/archetype.hpp"

namespace cloudgen::pipeline {

/// What drawn clouds of an archetype are found to take and to cover; the mean of its variants.
struct MeasuredCloud {
  double parts = 1;  ///< puffs that are drawn for one: dense ones are divided
  double wider = 1;  ///< covered ground over the nominal footprint
};

/// By archetype, puffs a cloud, and the optical depth of the layer.
struct MeasuredClouds {
  std::map<std::tuple<ArchetypeKey, int, double>, MeasuredCloud> known;
};

}  // namespace cloudgen::pipeline
