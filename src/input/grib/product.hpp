// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "input/grib/messages.hpp"

namespace cloudgen::input::grib {

/// Centres of WMO common code table C-1 that have habits of their own.
inline constexpr int kNcep = 7, kEcmwf = 98, kOffenbach = 78;

/// How a value stands in time.
enum class Span { Instant, Average, Other };

/// What is on a level, in the numbers of the file.
struct Product {
  int edition = 2;
  int centre = 0, subcentre = 0, process = 0;
  int table = 0;       ///< edition 1: parameter table
  int discipline = 0;  ///< edition 2, with category
  int category = 0;
  int number = 0;
  /// Edition 2: code table 4.5; 255 is missing. Edition 1: code table 3 and both octets of the level as one
  /// number (first) and apart (second: the last octet).
  int firstType = 255, secondType = 255;
  double firstValue = 0, secondValue = 0;
  Span span = Span::Instant;
  std::optional<base::UtcTime> run, valid;
  long member = 0;
  /// False where the values are no state of the air: probabilities, spreads, chemistry, satellite images.
  bool plain = true;
  std::vector<double> coordinates;  ///< of hybrid levels: all a, then all b
};

/// Throws InputError for sections that are cut short or have impossible dates.
Product readProduct(const FieldHead& head);

}  // namespace cloudgen::input::grib
