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
void placeClouds(const field::Grid& grid, const Options& options, const Generalisation& general,
                 const base::GeoBox& box, field::CloudTable& table);

}  // namespace cloudgen::pipeline
