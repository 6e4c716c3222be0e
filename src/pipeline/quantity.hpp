// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

/// What counts as covered where a sky is seen from straight above: an optical depth over 0.1, or, in layers
/// so thin that they would not reach it, over a third of their own.
inline constexpr double kCoveringOpticalDepth = 0.1;

/// Steps 4 and 5: how many clouds a layer has, where they stand and how large they are, such that what is
/// drawn of them, seen from above, covers fraction times area, and their optical depth adds up to the
/// layer's times that area. Clouds are placed block by block (Block): separate ones by chance, more of them
/// where a noise field is high; sheets on a jittered lattice, first where cover and noise are highest. The
/// footprint of each is painted on a canvas of the block, overlaps and all, and clouds are added until the
/// canvas is covered as the layers say; the last one is as large as still fits. Cover, heights and optical
/// depth pass smoothly from cell to cell (LayerAround), the noise knows no cells, and a block whose cover is
/// less than one small cloud's has one by chance, spread evenly over the blocks. Every cloud depends only on
/// seed, block and the layers in and around the block: a smaller box gives the same clouds. Appends to
/// table.clouds those whose anchor lies in the box. Where the source counts the clouds: countedClouds.
void placeClouds(const field::Grid& grid, const Options& options, const Generalisation& general,
                 const base::GeoBox& box, field::CloudTable& table);

}  // namespace cloudgen::pipeline
