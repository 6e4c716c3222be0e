// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/layer_record.hpp"
#include "scene/scene.hpp"

namespace cloudgen::cli {

/// Why a cloud is there: itself, the model layer that it stands for, and the rule that decided its genus with
/// all that was tried. As schemas/explain.schema.json says.
nlohmann::ordered_json explanationJson(const scene::CloudRecord& cloud, const pipeline::LayerRecord& record);

/// The same for a forecaster.
std::string explanationText(const scene::CloudRecord& cloud, const pipeline::LayerRecord& record);

}  // namespace cloudgen::cli
