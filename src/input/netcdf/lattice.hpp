// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "field/grid.hpp"

namespace cloudgen::input::netcdf {

/// A grid of columns at x and rows at y, in the units of `crs`. Longitudes may jump by 360; a last column
/// that repeats the first is dropped. Uneven rows are kept as they are; uneven columns of latitude-longitude
/// grids make a grid of centres. Throws InputError naming `where` if the coordinates do not run one way, or
/// are too many.
field::Grid latticeOf(const std::string& where, const std::string& crs, std::vector<double> x,
                      const std::vector<double>& y);

/// A grid of the centres of `rows` x `columns` cells, row by row; a lattice where rows and columns run along
/// the meridians and parallels. Throws InputError naming `where` if a centre is missing or off the Earth.
field::Grid gridOfCenters(const std::string& where, std::size_t columns, std::size_t rows,
                          std::span<const double> longitudes, std::span<const double> latitudes);

}  // namespace cloudgen::input::netcdf
