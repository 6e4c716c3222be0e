// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/volume.hpp"

namespace cloudgen::input {

/// True for names that end in .vdb, .nc, .nc4 or .cdf.
bool isVolumeFile(const std::filesystem::path& file);

/// Reads a cloud in a box from an OpenVDB grid or a NetCDF variable, averaged to at most 64 cells an axis.
/// `variable`: the grid or variable, by name or standard_name; empty: the grid "density" or the first of
/// floats, the variable that is cloud water. `zUp`: of OpenVDB alone. Throws InputError: damaged, no such
/// variable, no cloud in it.
base::Volume readVolume(const std::filesystem::path& file, const std::string& variable, bool zUp);

/// The formats.
base::Volume readVdb(const std::filesystem::path& file, const std::string& grid, bool zUp);
base::Volume readNetcdfVolume(const std::filesystem::path& file, const std::string& variable);

}  // namespace cloudgen::input
