// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/frame.hpp"
#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/footprint.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

/// Steps 4 and 5: how many clouds a layer has, where they stand and how large they are, such that what is
/// drawn of them, seen from above, covers fraction times area, and their optical depth adds up to the layer's
/// times that area (fitClouds). Where the source counts the clouds there are exactly that many
/// (countedClouds). `cells`: the grid's cells that touch the frame's box, ascending; clouds stand inside it.
/// Fills table.clouds. `footprints` are those of the options and the generalisation's puffs a cloud.
void placeClouds(const field::Grid& grid, const base::LocalFrame& frame, std::span<const std::uint32_t> cells,
                 const Options& options, const Generalisation& general, FootprintBook& footprints,
                 field::CloudTable& table);

/// The same within the budget of the options: what a generalisation draws is known when its clouds stand.
/// Where it is off by more than a quarter they are placed again under another one. Returns the last.
Generalisation placeWithinBudget(const field::Grid& grid, const base::LocalFrame& frame,
                                 std::span<const std::uint32_t> cells, const Options& options,
                                 field::CloudTable& table);

/// Puffs that are drawn of the clouds of a table, all of them in full.
double puffsDrawn(const field::CloudTable& table, const Options& options, const Generalisation& general);

}  // namespace cloudgen::pipeline
