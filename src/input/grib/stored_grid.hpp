// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "field/grid.hpp"
#include "input/grib/messages.hpp"

namespace cloudgen::input::grib {

/// A grid and how its values lie in the file. Its columns run eastwards (along x), its rows as in the file.
struct StoredGrid {
  field::Grid grid;
  int storedColumns = 0, storedRows = 0;  ///< one more column than the grid where the first one is repeated
  bool westwards = false;                 ///< the file's first column is the grid's last
  bool columnsFirst = false;              ///< consecutive values run along a column
  bool toAndFro = false;                  ///< every other row (or column) runs backwards

  /// Values in the file.
  std::size_t size() const;
  /// Place of a grid cell among the values of the file.
  std::size_t place(std::uint32_t cell) const;
};

/// Reads latitude-longitude, Gaussian (both also rotated and reduced), Lambert, Mercator, polar stereographic
/// and equal-area grids of both editions, and NCEP's rotated grids about a centre. Throws InputError for
/// other grids (naming what to do) and for absurd ones.
StoredGrid readGrid(const FieldHead& head);

/// Equal for fields on the same grid, whatever else their sections say.
std::string gridKey(const FieldHead& head);

/// Whether winds blow along the axes of a grid whose axes are not east and north.
bool windsAlongAxes(const FieldHead& head);

}  // namespace cloudgen::input::grib
