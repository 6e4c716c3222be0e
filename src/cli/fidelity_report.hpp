// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "check/fidelity/fidelity.hpp"

namespace cloudgen::cli {

/// What verify found, as schemas/verify.schema.json says.
nlohmann::ordered_json fidelityJson(const check::Fidelity& fidelity, const check::Tolerances& tolerances);

/// The same in a few lines for people.
std::string fidelityText(const check::Fidelity& fidelity, const check::Tolerances& tolerances);

}  // namespace cloudgen::cli
