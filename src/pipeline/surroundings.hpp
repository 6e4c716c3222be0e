// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"

namespace cloudgen::pipeline {

/// Where a layer lies, as far as the rules of types look at it. What is "around" is averaged over the layer
/// and the layers of cells nearby that go on from it: a genus is that of a cloud field, and a cell's own
/// cover follows every small change of its humidity.
struct Surroundings {
  double longitudeDegrees = 0, latitudeDegrees = 0;  ///< of the cell's centre
  float cellSquareKilometers = 0;
  float patchSquareKilometers = 0;  ///< covered ground of the layer's patch
  float coverAround = 0;            ///< 0..1
  float opticalDepthAround = 0;     ///< in cloud
  float kIndexAroundC = 0;          ///< NaN: unknown
};

/// Of every layer, in their order (any order of cells). Means are taken twice over a cell and those that
/// touch it, so that they reach two cells far; a layer there counts by its cell's area and by the share of
/// the thinner layer's depth that both have.
std::vector<Surroundings> surroundingsOf(const field::Grid& grid, const std::vector<field::Layer>& layers);

}  // namespace cloudgen::pipeline
