// SPDX-License-Identifier: Apache-2.0
#include "base/time.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace cloudgen::base {

UtcTime utcFromCivil(int year, int month, int day, int hour, int minute, int second) {
  using namespace std::chrono;
  const sys_days date = std::chrono::year{year} / static_cast<unsigned>(month) / static_cast<unsigned>(day);
  return {date.time_since_epoch().count() * std::int64_t{86400} + hour * 3600 + minute * 60 + second};
}

std::string isoText(UtcTime time) {
  using namespace std::chrono;
  const sys_seconds moment{seconds{time.seconds}};
  const auto date = floor<days>(moment);
  const year_month_day ymd{date};
  const hh_mm_ss clock{moment - date};
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(ymd.year()),
                     static_cast<unsigned>(ymd.month()), static_cast<unsigned>(ymd.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

std::optional<UtcTime> utcFromIso(std::string_view text) {
  const std::string copy(text);
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, used = 0;
  const auto matches = [&](const char* form, auto*... fields) {
    used = 0;
    return std::sscanf(copy.c_str(), form, fields..., &used) == static_cast<int>(sizeof...(fields)) &&
           used == static_cast<int>(copy.size());
  };
  const bool read = matches("%4d-%2d-%2dT%2d:%2d:%2dZ%n", &year, &month, &day, &hour, &minute, &second) ||
                    matches("%4d-%2d-%2dT%2d:%2dZ%n", &year, &month, &day, &hour, &minute) ||
                    matches("%4d-%2d-%2dT%2dZ%n", &year, &month, &day, &hour) ||
                    matches("%4d-%2d-%2d%n", &year, &month, &day);
  const std::chrono::year_month_day ymd{std::chrono::year{year}, std::chrono::month(month),
                                        std::chrono::day(day)};
  if (!read || !ymd.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 59)
    return std::nullopt;
  return utcFromCivil(year, month, day, hour, minute, second);
}

double julianDay(UtcTime time) { return 2440587.5 + static_cast<double>(time.seconds) / 86400.0; }

}  // namespace cloudgen::base
