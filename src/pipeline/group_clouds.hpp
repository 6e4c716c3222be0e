// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "pipeline/blocks.hpp"
#include "pipeline/footprint.hpp"
#include "pipeline/surroundings.hpp"

namespace cloudgen::pipeline {

/// What the clouds of all groups are made with.
struct GroupContext {
  const field::Grid& grid;
  const Options& options;
  const Generalisation& general;
  std::span<const field::Layer> layers;
  const Surroundings& surroundings;
  FootprintBook& footprints;
};

/// The clouds of a group, complete.
std::vector<field::Cloud> groupClouds(const GroupContext& context, const LayerGroup& group);

}  // namespace cloudgen::pipeline
