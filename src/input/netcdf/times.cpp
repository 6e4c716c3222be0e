// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr double kDay = 86400;
/// Years beyond about 9999 are damage.
constexpr double kMostSeconds = 2.5e11;
constexpr std::int64_t kFirstGregorianSecond = -12219292800;  // 1582-10-15

double floorTo(double value, double step) { return std::floor(value / step) * step; }

/// Days before each month of a year of 365 (or 366) days.
int daysBefore(int month, bool leap) {
  constexpr std::array<int, 13> kDays{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365};
  return kDays[static_cast<std::size_t>(month)] + (leap && month >= 2 ? 1 : 0);
}

/// The date of a calendar in which every year has 360, 365 or 366 days, in ours.
base::UtcTime inEvenYears(int daysPerYear, const TimeUnit& unit, double value) {
  const bool leap = daysPerYear == 366, months30 = daysPerYear == 360;
  const double clock = unit.originSeconds - floorTo(unit.originSeconds, kDay);
  const auto before = [&](int month) { return months30 ? month * 30 : daysBefore(month, leap); };
  const double seconds = clock + value * unit.seconds;
  const auto day = static_cast<std::int64_t>(std::floor(seconds / kDay)) +
                   std::int64_t{unit.year} * daysPerYear + before(unit.month - 1) + unit.day - 1;
  const auto year = static_cast<int>(std::floor(static_cast<double>(day) / daysPerYear));
  const auto dayOfYear = static_cast<int>(day - std::int64_t{year} * daysPerYear);
  int month = 1;
  while (month < 12 && before(month) <= dayOfYear) ++month;
  const int longest = month == 2 ? 28 : daysBefore(month, false) - daysBefore(month - 1, false);
  const int dayOfMonth = std::min(dayOfYear - before(month - 1) + 1, longest);
  base::UtcTime time = base::utcFromCivil(year, month, dayOfMonth);
  time.seconds += std::llround(seconds - floorTo(seconds, kDay));
  return time;
}

enum class Calendar { Standard, Proleptic, Days360, Days365, Days366 };

Calendar calendarOf(const File& file, const Variable& variable) {
  const std::string name = variable.text("calendar");
  const auto is = [&](std::string_view other) { return base::equalIgnoringCase(name, other); };
  if (name.empty() || is("standard") || is("gregorian")) return Calendar::Standard;
  if (is("proleptic_gregorian")) return Calendar::Proleptic;
  if (is("360_day")) return Calendar::Days360;
  if (is("noleap") || is("365_day")) return Calendar::Days365;
  if (is("all_leap") || is("366_day")) return Calendar::Days366;
  throw base::InputError(file.where(variable),
                         fmt::format("has the calendar \"{}\", which is not read", name),
                         "give times of the standard calendar");
}

base::UtcTime moment(Calendar calendar, const TimeUnit& unit, double value) {
  if (calendar == Calendar::Days360) return inEvenYears(360, unit, value);
  if (calendar == Calendar::Days365) return inEvenYears(365, unit, value);
  if (calendar == Calendar::Days366) return inEvenYears(366, unit, value);
  double origin = unit.originSeconds;
  if (calendar == Calendar::Proleptic && origin < static_cast<double>(kFirstGregorianSecond))
    origin = static_cast<double>(base::utcFromCivil(unit.year, unit.month, unit.day).seconds) + origin -
             floorTo(origin, kDay);
  return {std::llround(origin + value * unit.seconds)};
}

/// "day as %Y%m%d.%f": the date is the number.
std::optional<base::UtcTime> dateNumber(double value) {
  const auto date = static_cast<std::int64_t>(std::floor(value));
  const auto month = static_cast<int>(date / 100 % 100), day = static_cast<int>(date % 100);
  if (date < 10101 || date > 99991231 || month < 1 || month > 12 || day < 1 || day > 31) return std::nullopt;
  base::UtcTime time = base::utcFromCivil(static_cast<int>(date / 10000), month, day);
  time.seconds += std::llround((value - std::floor(value)) * kDay);
  return time;
}

}  // namespace

std::vector<std::optional<base::UtcTime>> moments(const File& file, const Variable& variable,
                                                  std::vector<field::Warning>& warnings) {
  const std::string text = variable.text("units");
  const bool dates = text.starts_with("day as %Y%m%d");
  const auto unit = timeUnit(text);
  if (!unit && !dates)
    throw base::InputError(file.where(variable), fmt::format("has the unit \"{}\", which is no time", text),
                           "write it like \"hours since 2020-01-01 00:00:00\"");
  const Calendar calendar = calendarOf(file, variable);
  if (calendar > Calendar::Proleptic)
    warnings.push_back({"model_calendar",
                        fmt::format("the times of {} count by the calendar {}: its dates are taken as ours",
                                    variable.name, variable.text("calendar"))});
  if (unit && unit->seconds > 27 * kDay)
    warnings.push_back(
        {"uneven_time_unit", fmt::format("times in \"{}\" count months or years of mean length", text)});
  std::vector<std::optional<base::UtcTime>> times;
  for (const double value : file.values(variable)) {
    if (dates)
      times.push_back(std::isfinite(value) ? dateNumber(value) : std::nullopt);
    else if (!(std::abs(value * unit->seconds) < kMostSeconds) ||
             !(std::abs(unit->originSeconds) < kMostSeconds))
      times.emplace_back();
    else
      times.emplace_back(moment(calendar, *unit, value));
  }
  return times;
}

std::optional<base::UtcTime> wrfTime(const std::string& text) {
  if (text.size() < 19 || text[10] != '_') return std::nullopt;
  return base::utcFromIso(text.substr(0, 10) + "T" + text.substr(11, 8) + "Z");
}

}  // namespace cloudgen::input::netcdf
