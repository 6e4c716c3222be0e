// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "field/source.hpp"
#include "input/cdfs/cloud_types.hpp"
#include "input/cdfs/mesh.hpp"

namespace cloudgen::input::cdfs {

inline constexpr std::size_t kLayers = 4;

/// Neither a height nor a type: "not filled".
inline constexpr std::int16_t kNoHeight = std::numeric_limits<std::int16_t>::min();
inline constexpr std::uint8_t kNotFilled = 25, kWmoMissing = 255;
/// Ages in minutes before the base time; the first means that the cell was never observed.
inline constexpr std::int16_t kNeverObserved = std::numeric_limits<std::int16_t>::max();

/// A whole analysis of one hour, as compact columns: cell after cell (row by row, the north before the
/// south), and where there are layers the four of a cell side by side. Columns that no file holds are empty.
struct Analysis {
  Mesh mesh;
  std::vector<Hemisphere> halves;
  TypeTable table = TypeTable::Afwa;
  base::UtcTime time;

  std::vector<std::uint8_t> amount;  ///< per cent; 0: no cloud
  std::vector<std::uint8_t> type;    ///< codes of `table`
  std::vector<std::int16_t> top, base;
  std::vector<float> opticalDepth;       ///< NaN or 0 where missing
  std::vector<std::uint8_t> totalCover;  ///< per cent, one a cell; 255: missing
  std::vector<std::int16_t> ageMinutes;  ///< one a cell

  std::vector<std::string> files, fields, unused;
  std::string format;
  std::vector<field::Warning> warnings;

  std::size_t cells() const { return mesh.size() * halves.size(); }

  /// A column for all halves, filled with `missing` on first use.
  template <class Value>
  static void provide(std::vector<Value>& column, std::size_t size, Value missing) {
    if (column.empty()) column.assign(size, missing);
  }
};

}  // namespace cloudgen::input::cdfs
