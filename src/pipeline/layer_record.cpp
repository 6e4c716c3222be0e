// SPDX-License-Identifier: Apache-2.0
#include "pipeline/layer_record.hpp"

#include <cassert>

namespace cloudgen::pipeline {

std::vector<LayerRecord> layersWithClouds(const field::CloudTable& table,
                                          const std::vector<Surroundings>& surroundings) {
  assert(table.layers.size() == surroundings.size());
  std::vector<bool> hasClouds(table.layers.size());
  for (const field::Cloud& cloud : table.clouds) hasClouds[cloud.layer] = true;
  std::vector<LayerRecord> records;
  for (std::size_t i = 0; i < table.layers.size(); ++i)
    if (hasClouds[i]) records.push_back({table.layers[i], surroundings[i]});
  return records;
}

}  // namespace cloudgen::pipeline
