// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "input/metar/stations.hpp"

namespace cloudgen::input {

/// A report of a cache file, which knows its place and time.
struct CachedReport {
  std::string raw;
  std::size_t line = 1;  ///< in JSON: the number of the element
  std::optional<base::UtcTime> time;
  std::optional<Station> station;
};

/// Whether the text is one of the files of aviationweather.gov: CSV with a heading from raw_text, XML with
/// METAR elements, JSON with rawOb members. Looks at the first 4096 bytes.
bool isMetarCache(std::string_view text);

/// Reads such a file. Rows without a raw report are passed over; places out of range count as none. Throws
/// InputError for JSON that is none.
std::vector<CachedReport> readMetarCache(std::string_view text, const std::string& where);

}  // namespace cloudgen::input
