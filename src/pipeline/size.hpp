// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "field/cloud_table.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

struct CloudSize {
  double widthMeters = 0, depthMeters = 0;
};

/// Step 5: the size of a cloud among those of a mean width in a layer of a depth; `layer` and `ordinal` are
/// its random address. Elements of a sheet are alike; widths of separate clouds follow a power law cut at
/// 0.45 and at 1.8 times the mean (number over area ~ A^-1.7, Landsat 1990); heaps are as deep as the layer
/// if they are large, and less deep if they are small; forms from files are as deep as the layer, and keep
/// their proportions nearly. The width is one that an archetype has: quantity
/// counts what will be drawn.
CloudSize sizeOf(const field::Layer& layer, std::uint32_t ordinal, double layerDepthMeters,
                 double meanWidthMeters, const Options& options);

}  // namespace cloudgen::pipeline
