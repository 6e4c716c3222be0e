// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace cloudgen::input {

/// A report as it stands in the text.
struct RawReport {
  std::vector<std::string_view> groups;  ///< station first; at most 100
  std::size_t line = 1;
  bool ended = false;  ///< by "="
  std::optional<base::UtcTime>
      near;  ///< a moment that its day of the month is nearest to, where the text has one
};

/// Finds the reports in a text: a station and a day with time begin one, "=" or the next ends it; whatever
/// stands between is passed over (bulletin headers, control characters, TAFs). A line "2024/02/08 14:00", as
/// files by cycle have, dates what follows. The groups are views of the text.
std::vector<RawReport> findReports(std::string_view text);

/// The day's noon of a date "20240208" or "2024-02-08" in a file's name; nothing if it has none.
std::optional<base::UtcTime> dateInName(std::string_view name);

}  // namespace cloudgen::input
