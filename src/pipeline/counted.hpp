// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/options.hpp"

namespace cloudgen::pipeline {

/// The clouds of a layer whose source counts them (Layer::cloudCount): exactly so many stand in its cell,
/// each for its share of fraction times area: at least spacingMeters from each other within the cell (fewer
/// where 100 throws a cloud find no room), or, without a spacing, in clusters; those of sheets on a jittered
/// lattice. `index` is the layer's in the table.
std::vector<field::Cloud> countedClouds(const field::Grid& grid, const Options& options,
                                        const field::Layer& layer, std::uint32_t index);

}  // namespace cloudgen::pipeline
