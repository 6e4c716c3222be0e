// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "field/grid.hpp"
#include "field/source.hpp"
#include "input/netcdf/axes.hpp"
#include "input/netcdf/slab.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input::netcdf {

/// The grid of a variable, and where its cells lie along the variable's dimensions.
struct Horizontal {
  std::string key;  ///< equal for equal grids, in whatever file
  std::function<field::Grid()> make;
  std::size_t columns = 1, rows = 1;
  bool points = false;        ///< one dimension holds all cells
  bool columnsFirst = false;  ///< of points: consecutive ones run along a column

  std::vector<Place> places(std::span<const std::uint32_t> cells) const;
};

/// The grid of a variable with horizontal dimensions: by 1-D coordinates (latitude and longitude, or those of
/// a CF grid mapping), else by latitude and longitude of each cell. What cannot be placed throws InputError
/// when the grid is made.
Horizontal horizontalOf(const File& file, const Axes& axes, const Placed& placed,
                        std::vector<field::Warning>& warnings);

/// The only cell of a file without horizontal dimensions: a square of the model's resolution about its place.
Horizontal columnOf(const File& file, const Axes& axes, const OpenOptions& options,
                    std::vector<field::Warning>& warnings);

}  // namespace cloudgen::input::netcdf
