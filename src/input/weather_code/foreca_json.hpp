// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/weather_code/symbol.hpp"

namespace cloudgen::input {

/// One entry of a forecast: a symbol with its time, and what else it tells.
struct CodedHour {
  base::UtcTime time;
  Symbol symbol;
  std::optional<double> temperatureC, dewPointC, windFromDegrees, windSpeed;
};

struct CodedPlace {
  std::string name;  ///< for messages
  std::optional<field::GeoPoint> point;
  std::optional<double> elevationMeters;
  std::vector<CodedHour> hours;
};

/// Reads Foreca's JSON: an object with "weather" (members s, t or d, temp or maxT and minT, wd, ws), with
/// "forecast" or "current" (the public API: symbol, time or date, temperature or maxTemp and minTemp,
/// dewPoint, relHumidity, windDir, windSpeed), or an array of such objects; the place is lat and lon (and
/// elevation), there or in "location". Times are UTC or carry an offset; a date alone is its midnight UTC. A
/// day's temperature is its maximum, its dew point the minimum (FAO-56, Allen 1998, eq. 48). Throws
/// InputError that names the place in the document.
std::vector<CodedPlace> readForecaJson(std::string_view text, const std::string& where);

}  // namespace cloudgen::input
