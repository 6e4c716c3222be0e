// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "field/cloud_table.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

/// Step 5: width, base, depth and optical depth of every cloud of the table. Heaps of one layer share its
/// base; the depth is the layer's for the largest and less for smaller ones; widths follow a power law cut at
/// a third and at 1.8 times the mean (number over area ~ A^-1.7, Landsat 1990) whose mean footprint is what
/// quantity counted on. Optical depth times footprint is, in the mean over the layer, the layer's optical
/// depth times the ground it covers.
void sizeClouds(const Options& options, const Generalisation& general, field::CloudTable& table);

}  // namespace cloudgen::pipeline
