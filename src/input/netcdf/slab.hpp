// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "input/netcdf/axes.hpp"

namespace cloudgen::input::netcdf {

/// Which values along the dimensions that are not horizontal.
struct Slice {
  std::size_t time = 0, step = 0, member = 0, level = 0;
};

/// Where a cell lies along the horizontal dimensions (a point: in `column`).
struct Place {
  std::size_t row = 0, column = 0;
};

/// The unpacked values at places, NaN where missing, in their order. Reads the rows and columns between those
/// of the places, a few million values at a time, so memory does not grow with the file. Where ERA5 keeps its
/// preliminary part apart (expver), the second version fills the holes of the first.
std::vector<double> valuesAt(const File& file, const Placed& placed, const Slice& slice,
                             std::span<const Place> places);

}  // namespace cloudgen::input::netcdf
