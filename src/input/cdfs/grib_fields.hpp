// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "input/cdfs/analysis.hpp"
#include "input/grib/messages.hpp"

namespace cloudgen::input::cdfs {

enum class GribColumn : unsigned char {
  Amount,
  Type,
  Base,
  Top,
  OpticalDepth,
  TotalCover,
  UpdateTime,
  Other
};

/// A message of a WWMCA file in GRIB, known by its headers.
struct GribField {
  grib::FieldHead head;
  GribColumn column = GribColumn::Other;
  std::size_t layer = 0;  ///< 0..3, of columns with layers
  Hemisphere half{};
  base::UtcTime time;
};

/// True if the first message of a file is one of WWMCA's: GRIB1 of centre 57 (US Air Force) with parameter
/// 163, 164, 227, 228 or 185 on level type 109, or 71 or 183 on 200; GRIB2 with a cloud type (discipline 0,
/// category 6, number 8), or another cloud field of centre 57.
bool startsLikeWwmca(std::string_view firstBytes);

/// The messages of a file that are WWMCA's; what else is in it becomes a line of `unused`. Throws InputError.
std::vector<GribField> gribFieldsOf(const std::filesystem::path& file, std::vector<std::string>& unused);

/// The grid that the headers of these messages describe (they must agree). Throws InputError: another
/// projection, absurd sizes.
Mesh meshOf(const std::vector<GribField>& fields, std::vector<field::Warning>& warnings);

/// Decodes messages into the columns of `analysis`, as half number `half`; a column is one task, four at a
/// time.
///
/// Optical depths are stored times ten (LISF read_cod): whole numbers, or any over 200, are divided by ten,
/// with the warning "optical_depth_x10". Times of last update are minutes from the base time (of either sign)
/// or, where they pass a million, minutes since 1967-12-31. Throws InputError.
class GribReader {
 public:
  explicit GribReader(Analysis& analysis) : analysis_(analysis) {}
  void read(const std::vector<GribField>& fields, std::size_t half);
  void finish();

 private:
  void provide(GribColumn column);
  void keep(const GribField& field, const std::vector<double>& values, std::size_t half);
  float keepDepth(double value);
  void keepAges(const std::vector<double>& values, std::size_t first);

  Analysis& analysis_;
  double largestDepth_ = 0;
  bool fractionalDepth_ = false, absoluteTimes_ = false;
};

}  // namespace cloudgen::input::cdfs
