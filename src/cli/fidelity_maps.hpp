// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/frame.hpp"
#include "check/fidelity/fidelity.hpp"
#include "field/grid.hpp"

namespace cloudgen::cli {

/// Writes cover.png, cover_low.png, cover_middle.png, cover_high.png, optical_depth.png, base.png and top.png
/// into a folder that exists: model, scene and scene minus model side by side, north up, a model cell after
/// the other. Values run from dark blue to white; the difference from blue (too little, too low) over white
/// to red, its full tones being 0.5 of cover, half the greatest optical depth and 1000 m; grey is where
/// nothing is to be compared. Returns the names. Throws OutputError.
std::vector<std::string> writeFidelityMaps(const check::Fidelity& fidelity, const field::Grid& grid,
                                           const base::GeoBox& box, const std::filesystem::path& folder);

}  // namespace cloudgen::cli
