// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

bool isGrib(std::string_view firstBytes);

/// Opens GRIB1 or GRIB2 files that together hold the fields of one model run, on pressure levels and a
/// regular latitude-longitude grid. Headers are read now, data later, one level at a time. Of several valid
/// times or ensemble members the first is taken, and a warning names the others. Throws InputError: empty,
/// cut short, damaged, no cloud water, another grid or kind of level.
std::unique_ptr<field::Source> openGrib(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options);

}  // namespace cloudgen::input
