// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::size_t kLongestUnit = 200;

/// What files write, and what UDUNITS calls it. "mb" would be millibarns there, "C" a coulomb.
constexpr std::array<std::pair<std::string_view, std::string_view>, 34> kSpellings{{
    {"(0 - 1)", "1"},
    {"(0-1)", "1"},
    {"0-1", "1"},
    {"0 - 1", "1"},
    {"[0-1]", "1"},
    {"~", "1"},
    {"-", "1"},
    {"none", "1"},
    {"dimensionless", "1"},
    {"unitless", "1"},
    {"nondim", "1"},
    {"fraction", "1"},
    {"proportion", "1"},
    {"ratio", "1"},
    {"numeric", "1"},
    {"kg kg**-1", "1"},
    {"kg/kg", "1"},
    {"kg kg^-1", "1"},
    {"(% )", "%"},
    {"pct", "%"},
    {"percentage", "%"},
    {"mb", "hPa"},
    {"mbar", "hPa"},
    {"millibars", "hPa"},
    {"mbars", "hPa"},
    {"c", "degC"},
    {"deg c", "degC"},
    {"degrees c", "degC"},
    {"deg k", "K"},
    {"degrees k", "K"},
    {"gpm", "m"},
    {"geopotential meter", "m"},
    {"geopotential metre", "m"},
    {"gpdm", "dam"},
}};

struct Release {
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, Release>;
using Converter = std::unique_ptr<cv_converter, Release>;

std::mutex& libraryMutex() {
  static std::mutex mutex;
  return mutex;
}

ut_system* unitSystem() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  if (!system)
    throw base::InputError("UDUNITS", "finds no database of units", "install the package libudunits2-data");
  return system;
}

/// "m**2 s**-2" as "m^2 s^-2".
std::string respelled(std::string_view text) {
  for (const auto& [written, meant] : kSpellings)
    if (base::equalIgnoringCase(text, written)) return std::string(meant);
  std::string unit;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool power = text.substr(i).starts_with("**");
    unit += power ? '^' : text[i];
    i += power;
  }
  return unit;
}

Unit parsed(const std::string& text) {
  // UDUNITS takes blanks at the ends amiss.
  std::string trimmed = text;
  ut_system* const system = unitSystem();
  return Unit(ut_parse(system, ut_trim(trimmed.data(), UT_UTF8), UT_UTF8));
}

std::optional<Conversion> between(const std::string& from, const std::string& to) {
  const Unit source = parsed(from), target = parsed(to);
  if (!source || !target || !ut_are_convertible(source.get(), target.get())) return std::nullopt;
  const Converter converter(ut_get_converter(source.get(), target.get()));
  if (!converter) return std::nullopt;
  const double offset = cv_convert_double(converter.get(), 0.0);
  const double factor = cv_convert_double(converter.get(), 1.0) - offset;
  // Reciprocal and logarithmic units are not what is wanted here.
  const double linear = 2 * factor + offset, second = cv_convert_double(converter.get(), 2.0);
  if (!std::isfinite(factor) || !std::isfinite(offset) ||
      std::abs(linear - second) > 1e-9 * (std::abs(factor) + std::abs(offset)))
    return std::nullopt;
  return Conversion{factor, offset};
}

}  // namespace

std::optional<Conversion> conversion(std::string_view from, const char* to) {
  if (from.empty() || from.size() > kLongestUnit) return std::nullopt;
  const std::lock_guard lock(libraryMutex());
  return between(respelled(from), to);
}

bool isPercent(std::string_view unit) {
  const auto toOne = conversion(unit, "1");
  return toOne && std::abs(toOne->factor - 0.01) < 1e-6;
}

std::optional<TimeUnit> timeUnit(const std::string& text) {
  const std::size_t since = text.find(" since ");
  if (since == std::string::npos || text.size() > kLongestUnit) return std::nullopt;
  TimeUnit unit;
  const std::lock_guard lock(libraryMutex());
  const auto length = between(text.substr(0, since), "s");
  const auto origin = between(text, "seconds since 1970-01-01 00:00:00 UTC");
  if (!length || !origin || !(length->factor > 0)) return std::nullopt;
  unit.seconds = length->factor;
  // A converter of two such units maps 0 to the origin.
  unit.originSeconds = origin->offset;
  if (std::sscanf(text.c_str() + since + 7, "%d-%d-%d", &unit.year, &unit.month, &unit.day) != 3)
    return std::nullopt;
  if (unit.month < 1 || unit.month > 12 || unit.day < 1 || unit.day > 31 || std::abs(unit.year) > 10000)
    return std::nullopt;
  return unit;
}

}  // namespace cloudgen::input::netcdf
