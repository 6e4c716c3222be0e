// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "input/netcdf/builder.hpp"
#include "input/netcdf/file.hpp"

namespace cloudgen::input::netcdf {

/// True of the output of WRF itself (wrfout), which keeps perturbations and base states apart on a staggered
/// grid.
bool isWrf(const File& file);

/// Adds the fields of a wrfout file, brought to the middle of its cells: heights from PH + PHB, pressure P +
/// PB, temperature from T, water per kg of moist air.
void addWrf(const std::shared_ptr<const File>& file, Builder& builder);

}  // namespace cloudgen::input::netcdf
