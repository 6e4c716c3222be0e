// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "field/source.hpp"

namespace cloudgen::test {

/// A made cloud analysis of one hemisphere on the mesh of size x size cells (1024: WWMCA's), layers of a cell
/// side by side. Clear layers are all zero.
struct MadeAnalysis {
  int size = 1024;
  bool south = false;
  base::UtcTime time;
  std::vector<std::uint8_t> type, amount;  ///< AFWA codes; per cent
  std::vector<std::int16_t> base, top;     ///< m
  std::vector<std::uint16_t> opticalDepthTimesTen;
  std::vector<std::uint8_t> totalCover;   ///< per cent, one a cell
  std::vector<std::uint16_t> ageMinutes;  ///< one a cell

  std::size_t cells() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
  std::size_t slot(int column, int row, int layer) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
            static_cast<std::size_t>(column)) *
               4 +
           static_cast<std::size_t>(layer);
  }
};

MadeAnalysis clearAnalysis(bool south, base::UtcTime time, int size = 1024);

/// Centre of a cell by the Air Force's formula (LISF pstoll), column and row from 0.
field::GeoPoint meshCenter(int size, bool south, int column, int row);

/// A sky sampled at the centres of the cells; at most four layers a cell (throws std::runtime_error). Cc
/// becomes Ci and fog becomes St, which CDFS II does not have.
MadeAnalysis sampled(const field::Source& sky, bool south, int size = 1024);

/// A GRIB1 message of centre 57 with whole numbers of 8 or 16 bits, layer by layer; `layer` is 1..4.
std::string wwmcaMessage(const MadeAnalysis& analysis, int parameter, int layer);

/// All messages of a file: amounts, types, bases, tops, optical depths (times ten), total cover, update
/// times.
std::string wwmcaGrib(const MadeAnalysis& analysis);

/// Writes WWMCA_YYYYMMDDHH_{N|S}_16_M.GR1 and gives its path.
std::filesystem::path writeWwmcaGrib(const MadeAnalysis& analysis, const std::filesystem::path& folder);

/// Writes the raw set (type, amounts, tops, times, total cover) and gives the paths, types first.
std::vector<std::filesystem::path> writeWwmcaRaw(const MadeAnalysis& analysis,
                                                 const std::filesystem::path& folder,
                                                 std::endian order = std::endian::big);

}  // namespace cloudgen::test
