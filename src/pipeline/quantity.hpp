// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

/// Step 4: how many clouds a layer has in its cell and where they stand, so that their footprints add up to
/// fraction times area. Separate clouds stand by chance, more of them where a noise field is high; sheets
/// stand on a jittered lattice whose emptiest places, by the same noise, stay free. Every place depends only
/// on seed, cell, layer and number: a smaller box gives the same clouds. Appends to table.clouds those whose
/// anchor lies in the box.
/// Where the source counts the clouds of a cell (Layer::cloudCount), exactly so many stand in it, each for
/// its share of fraction times area: at least spacingMeters from each other within the cell (fewer where 100
/// throws a cloud find no room), or, without a spacing, in clusters; those of sheets on the lattice.
void placeClouds(const field::Grid& grid, const Options& options, const Generalisation& general,
                 const base::GeoBox& box, field::CloudTable& table);

}  // namespace cloudgen::pipeline
