// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "field/cloud_columns.hpp"
#include "field/cloud_table.hpp"
#include "field/source.hpp"

namespace cloudgen::pipeline {

/// Step 2: the cloudy layers of each column, from the cells up: a layer ends at a clear level, or where the
/// water falls under a tenth of what is below and above. Its cover is the largest fraction of its levels
/// (maximum overlap within a layer); its optical depth keeps the column's grid-mean optical depth.
std::vector<field::Layer> locateLayers(const field::CloudColumns& columns);

/// The same from the layers that a source states outright at `cells` (ascending).
std::vector<field::Layer> locateLayers(const field::Source& source, std::span<const std::uint32_t> cells);

/// One of them; `ordinal` counts those of a cell upwards.
field::Layer layerFrom(const field::StatedLayer& stated, std::uint16_t ordinal);

/// Numbers the patches: layers of neighbouring cells that overlap in height by half of the thinner one belong
/// together. Returns the number of patches.
std::uint32_t joinPatches(const field::Grid& grid, std::vector<field::Layer>& layers);

}  // namespace cloudgen::pipeline
