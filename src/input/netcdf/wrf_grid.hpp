// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/netcdf/builder.hpp"
#include "input/netcdf/file.hpp"
#include "input/netcdf/horizontal.hpp"

namespace cloudgen::input::netcdf {

/// The mass points of a wrfout file: a lattice on WRF's sphere (R = 6370 km) by MAP_PROJ, TRUELAT1, TRUELAT2
/// and STAND_LON, laid through XLAT and XLONG; where that misses them by more than 10 m, a grid of their
/// centres.
Horizontal wrfGrid(const File& file, Builder& builder);

}  // namespace cloudgen::input::netcdf
