// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"
#include "field/source.hpp"
#include "input/grib/handle.hpp"

namespace cloudgen::input::grib {

/// What a field is used for, beside the quantities of levels.
enum class Role { Other, Level, SurfacePressure, SurfaceHeight };

/// What the header of a field says; the data are not touched.
struct FieldHeader {
  FieldLocation location;
  std::string shortName, levelType, gridType;
  Role role = Role::Other;
  std::optional<field::Quantity> quantity;  ///< of fields on levels
  double factor = 1;                        ///< from the file's unit to SI
  double pressurePa = 0;                    ///< of isobaric levels
  base::UtcTime run, valid;
  std::string gridKey;  ///< equal for fields on the same grid
  long member = 0;      ///< of an ensemble
};

FieldHeader readHeader(const Handle& handle);

/// "NCEP GFS", or centre and process by number.
std::string modelName(const Handle& handle);

/// A grid and how its values lie in the file.
struct StoredGrid {
  field::Grid grid;
  int storedColumns = 0, storedRows = 0;  ///< one more column than the grid where the first one is repeated
  bool columnsFirst = false;              ///< consecutive values run along a column

  std::size_t size() const {
    return static_cast<std::size_t>(storedColumns) * static_cast<std::size_t>(storedRows);
  }
  /// Place of a grid cell among the values of the file.
  std::size_t place(std::uint32_t cell) const;
};

/// Reads a regular latitude-longitude grid; throws InputError for other grids (naming what to do) and for
/// absurd ones.
StoredGrid readGrid(const Handle& handle);

}  // namespace cloudgen::input::grib
