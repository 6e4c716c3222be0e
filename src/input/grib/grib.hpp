// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "input/model/model_field.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

bool isGrib(std::string_view firstBytes);

/// Opens GRIB1 and GRIB2 files of a model: grib::readContents() and model::makeSource(). Throws InputError:
/// empty, cut short, damaged, nothing about clouds, a grid that cannot be placed.
std::unique_ptr<field::Source> openGrib(const std::vector<std::filesystem::path>& files,
                                        const OpenOptions& options);

namespace grib {

/// The fields of files by meaning. Headers are read now, data when a field is asked for. Fields that hold at
/// a moment go before averages of the same; those are taken where nothing else is there, with the warning
/// "averaged_cover". Throws InputError.
model::Contents readContents(const std::vector<std::filesystem::path>& files);

}  // namespace grib

}  // namespace cloudgen::input
