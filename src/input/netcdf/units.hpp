// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cloudgen::input::netcdf {

/// value in the wanted unit = value * factor + offset
struct Conversion {
  double factor = 1, offset = 0;
};

/// By UDUNITS-2; odd spellings of NetCDF files ("(0 - 1)", "~", "mb", "kg kg**-1") are understood. Nothing if
/// the text is no unit, or measures something else. An empty text has no unit and converts to none.
std::optional<Conversion> conversion(std::string_view from, const char* to);

/// True if the text says per cent.
bool isPercent(std::string_view unit);

/// Of "hours since 2019-01-01 00:00:00".
struct TimeUnit {
  double seconds = 1;        ///< one unit
  double originSeconds = 0;  ///< since 1970-01-01T00:00Z, by the calendar that changes in 1582
  int year = 1970, month = 1, day = 1;
};

/// Nothing if the text is no such unit.
std::optional<TimeUnit> timeUnit(const std::string& text);

}  // namespace cloudgen::input::netcdf
