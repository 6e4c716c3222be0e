// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "check/fidelity/written_scene.hpp"

namespace cloudgen::cli {

/// Reads the scene of a folder for verification: "x3d" or "splats"; "auto" takes the splats if they are
/// there, as they keep every puff, and the names of the clouds from the X3D beside them. Throws InputError if
/// there is neither.
check::WrittenScene readWritten(const std::filesystem::path& folder, const std::string& format,
                                const base::Progress& progress);

}  // namespace cloudgen::cli
