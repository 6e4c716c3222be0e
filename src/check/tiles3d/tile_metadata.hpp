// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace cloudgen::check {

/// What is wrong with the metadata of a tile (or tileset, group, content) against the schema of its tileset;
/// an empty text if nothing is. Checked are the class, that every property is one of it, that those it
/// demands are there, and that numbers, texts and arrays are where the class has them.
std::string metadataFault(const nlohmann::json& metadata, const nlohmann::json& schema);

}  // namespace cloudgen::check
