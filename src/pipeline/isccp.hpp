// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>

#include "base/genus.hpp"
#include "field/cloud_table.hpp"

namespace cloudgen::pipeline {

/// ISCCP's class of a cloud by what its satellites see, optical depth and cloud-top pressure: "cumulus",
/// "stratocumulus", "stratus" below 680 hPa, "altocumulus", "altostratus", "nimbostratus" to 440 hPa,
/// "cirrus", "cirrostratus", "deep convection" above; split at optical depths 3.6 and 23 (Rossow & Schiffer
/// 1999).
std::string_view isccpClass(double opticalDepth, double topPressurePa);

/// How many layers of each ISCCP class got which genus; layers without a known cloud-top pressure are left
/// out. ISCCP looks from above and knows no base: Cs over 440 hPa may well be a Cb's anvil.
std::map<std::string_view, std::map<base::Genus, std::uint64_t>> isccpConfusion(
    std::span<const field::Layer> layers);

}  // namespace cloudgen::pipeline
