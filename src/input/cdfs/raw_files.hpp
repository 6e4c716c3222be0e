// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <filesystem>
#include <optional>
#include <vector>

#include "input/cdfs/analysis.hpp"

namespace cloudgen::input::cdfs {

enum class RawField : unsigned char {
  Type,       ///< WWMCA_LYRD_CLOUD_TYPE_: a byte a layer
  Amount,     ///< WWMCA_LYRD_CLOUD_PCTS_: a byte a layer, per cent
  Top,        ///< WWMCA_LYRD_TOPS_HGHTS_: 16 bits a layer, m
  Time,       ///< WWMCA_PIXL_TIME_MEANS_: 32 bits a cell, minutes since 1967-12-31, 0 for never
  TotalCover  ///< WWMCA_TOTAL_CLOUD_PCT_: a byte a cell, per cent, row 0 at the top (MET)
};

/// A raw file has no header: what it holds is in its name, prefix + "NH_" or "SH_" + YYYYMMDDHH (with or
/// without an extension).
struct RawFile {
  std::filesystem::path path;
  RawField field{};
  Hemisphere half{};
  base::UtcTime time;
};

/// Nothing if the file is not named as one.
std::optional<RawFile> rawFileOf(const std::filesystem::path& path);

/// Reads the files of one hemisphere and one hour into the columns of `analysis`, as half number `half`. Byte
/// order: `forced`, else the one in which more of the times lie near the base time, else in which more of the
/// heights are plausible, else big-endian; the warning "byte_order" says what was taken where it is not
/// plainly big-endian. Throws InputError: unreadable, not of the exact size, times that fit neither order.
void readRaw(const std::vector<RawFile>& files, std::size_t half, std::optional<std::endian> forced,
             Analysis& analysis);

}  // namespace cloudgen::input::cdfs
