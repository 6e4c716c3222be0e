// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

/// True for cloud analyses of CDFS II (WWMCA): raw binary files by their names, GRIB files by their first
/// bytes.
bool isCdfs(const std::filesystem::path& file, std::string_view firstBytes);

/// Opens files of WWMCA, raw and GRIB in any mixture, of one hemisphere or both and of any number of hours;
/// the hour wanted is chosen among them. Tells up to four layers a cell; a pair of hemispheres is one grid
/// with its seam at the equator. Heights are taken as above mean sea level. Throws InputError: damaged, cut
/// short, no amounts or no heights, an hour that is not there.
std::unique_ptr<field::Source> openCdfs(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options);

/// The same for raw files of another mesh than the sixteenth (1024): `size` x `size` cells.
std::unique_ptr<field::Source> openCdfs(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options, int size);

}  // namespace cloudgen::input
