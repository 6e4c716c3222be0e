// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "field/grid.hpp"

namespace cloudgen::field {

/// One cloudy model cell. Extinction is in-cloud: grid-mean water divided by the cloud fraction.
struct CloudCell {
  std::uint32_t level = 0;  ///< counted from the ground
  float baseMeters = 0, topMeters = 0;
  float fraction = 0;  ///< horizontal, 0..1
  float liquidExtinctionPerMeter = 0, iceExtinctionPerMeter = 0;
  float temperatureK = 0, relativeHumidity = 0;
  float windEast = 0, windNorth = 0;  ///< m/s
  float pressurePa = 0;
};

/// What the column says whether or not it is cloudy; steps 1 to 3 use it.
struct ColumnState {
  float surfaceHeightMeters =
      0;  ///< ground; where nothing tells it, the lowest level, of isobaric ones the sea
  float temperature850K = 0, temperature500K = 0, dewPoint850K = 0, temperature700K = 0, dewPoint700K = 0;
  float kIndexC = 0;  ///< K-index, George 1960; NaN where levels are missing
};

/// The wind somewhere in the air, cloudy or clear.
struct WindAloft {
  std::uint32_t cell = 0;  ///< of the grid
  float heightMeters = 0, windEast = 0, windNorth = 0;  ///< m/s
};

/// Columns of the box in which the wind is kept at every level, as far as there are so many.
inline constexpr std::size_t kWindColumns = 10'000;

/// Sparse: only cloudy cells are kept. Column c (of `columns`) has the cells [start[c], start[c+1]), upwards.
struct CloudColumns {
  Grid grid;
  std::vector<std::uint32_t> columns;  ///< grid indices, ascending: all that were asked for
  std::vector<ColumnState> states;     ///< one a column
  std::vector<std::uint32_t> start;    ///< columns.size() + 1
  std::vector<CloudCell> cells;
  std::vector<WindAloft> winds;  ///< of columns spread over all
  /// What was not in the input, and how it was made: (what, how), one line each.
  std::vector<std::pair<std::string, std::string>> derived;
};

}  // namespace cloudgen::field
