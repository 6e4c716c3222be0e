// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cloudgen::input::netcdf {

/// True for the first bytes of netCDF's classic formats (CDF-1, CDF-2, CDF-5).
bool isClassic(std::string_view firstBytes);

/// Checks the header of a classic file against its length, since netCDF-C takes what is missing at the end
/// for zeros. True if the file is a classic one, false if it is something else. Throws InputError: the header
/// is damaged, or a variable does not lie within the file. Layout: NetCDF Users Guide, appendix "File Format
/// Specifications".
bool checkClassicHeader(const std::filesystem::path& path, const std::string& name);

}  // namespace cloudgen::input::netcdf
