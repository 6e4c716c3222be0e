// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cloudgen::base {

/// A UTC moment, in whole seconds since 1970-01-01T00:00Z.
struct UtcTime {
  std::int64_t seconds = 0;
  auto operator<=>(const UtcTime&) const = default;
};

/// Civil date and time of day to UTC; month 1..12, day 1..31. Valid for any year of the Gregorian calendar.
UtcTime utcFromCivil(int year, int month, int day, int hour = 0, int minute = 0, int second = 0);

/// "2011-01-15T12:00:00Z".
std::string isoText(UtcTime time);

/// Reads "YYYY-MM-DDThh[:mm[:ss]]Z" and "YYYY-MM-DD"; nothing if it is not such a text.
std::optional<UtcTime> utcFromIso(std::string_view text);

/// Julian day (UT) of a moment.
double julianDay(UtcTime time);

}  // namespace cloudgen::base
