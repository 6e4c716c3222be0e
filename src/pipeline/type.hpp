// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/surroundings.hpp"
#include "pipeline/type_rules.hpp"

namespace cloudgen::pipeline {

/// What a rule id means, for `explain` and reports.
struct TypeRule {
  std::string_view id;
  std::string meaning;
};
std::span<const TypeRule> typeRules();

/// The traits that the rules look at.
Traits traitsOf(const field::Layer& layer, const Surroundings& surroundings);

/// Step 3: the genus of every layer that has none yet (rule empty), in the order of CDFS II (thesis ch. IV):
/// first cirrus, cumulonimbus and fog by signature; then cumuliform or stratiform by horizontal extent; then
/// by height. Fills genus and rule. Returns what lies around each layer, in their order.
std::vector<Surroundings> typeLayers(const field::Grid& grid, std::vector<field::Layer>& layers);

}  // namespace cloudgen::pipeline
