// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pipeline/surroundings.hpp"

namespace cloudgen::pipeline {

/// What clouds were made from and what decided their type: kept for `explain`.
struct LayerRecord {
  field::Layer layer;
  Surroundings surroundings;
};

/// The layers that have clouds, in the order of the table. `surroundings` are those of all its layers.
std::vector<LayerRecord> layersWithClouds(const field::CloudTable& table,
                                          const std::vector<Surroundings>& surroundings);

}  // namespace cloudgen::pipeline
