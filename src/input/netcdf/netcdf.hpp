// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/model/model_field.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

/// True for the first bytes of netCDF (classic, 64-bit offset, 64-bit data) and HDF5 files.
bool isNetcdf(std::string_view firstBytes);

/// Opens netCDF files that together hold the fields of one model run: files of the CF conventions, output of
/// WRF, single columns. Headers and coordinates are read now, data later, by slab. Throws InputError: cut
/// short, damaged, nothing about clouds, a grid that cannot be placed.
std::unique_ptr<field::Source> openNetcdf(const std::vector<std::filesystem::path>& files,
                                          const OpenOptions& options);

namespace netcdf {

/// What openNetcdf() chooses from.
model::Contents readContents(const std::vector<std::filesystem::path>& files, const OpenOptions& options);

}  // namespace netcdf
}  // namespace cloudgen::input
