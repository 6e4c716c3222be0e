// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "input/netcdf/builder.hpp"
#include "input/netcdf/file.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input::netcdf {

/// Adds the fields of a file that follows the CF conventions, closely or loosely: gridded models and single
/// columns.
void addCf(const std::shared_ptr<const File>& file, const OpenOptions& options, Builder& builder);

}  // namespace cloudgen::input::netcdf
