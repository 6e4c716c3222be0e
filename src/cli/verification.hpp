// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/frame.hpp"
#include "check/fidelity/written_scene.hpp"
#include "field/source.hpp"

namespace cloudgen::cli {

/// Reads the scene of a folder for verification: "pack", "x3d", "splats", "glb" or "tiles", which stand on the globe
/// and are taken back to the frame; "auto" takes the pack if it is there, as it keeps every puff, how dense it is and
/// the names of the clouds; else the splats, with the names from the X3D beside them; else X3D, GLB, tiles. Throws
/// InputError if it is not there. So many seconds after the valid time of a sky that moves, which splats
/// cannot tell, and tiles only on the hour.
check::WrittenScene readWritten(const std::filesystem::path& folder, const std::string& format,
                                const base::LocalFrame& frame, const base::Progress& progress, double seconds = 0);

/// Reads a scene that a build has written to a folder ("auto") on ground of a height, compares it with its
/// model and draws the maps into its folder verify/. Returns what fidelityJson says. Throws InputError,
/// OutputError.
nlohmann::ordered_json verifyWritten(const std::filesystem::path& folder, const base::LocalFrame& frame,
                                     double groundMeters, const field::Source& model,
                                     const field::Source* typing, const base::Progress& progress);

}  // namespace cloudgen::cli
