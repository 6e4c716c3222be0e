// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "field/source.hpp"
#include "pipeline/moving.hpp"

namespace cloudgen::cli {

/// What was read, decided and made: report.json, as schemas/report.schema.json says. `files` are the names
/// written to the folder. Only timings_seconds may differ between two runs.
nlohmann::ordered_json reportOf(const field::Source& source, const field::Source* typing,
                                const pipeline::Outcome& outcome, const std::filesystem::path& folder,
                                const std::vector<std::pair<std::string, double>>& timingsSeconds);

/// The part of the report on a sky that moves.
nlohmann::ordered_json motionOf(const pipeline::MovingSky& sky);

}  // namespace cloudgen::cli
