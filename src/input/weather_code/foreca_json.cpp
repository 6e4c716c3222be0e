// SPDX-License-Identifier: Apache-2.0
#include "input/weather_code/foreca_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "input/described/json_place.hpp"

namespace cloudgen::input {
namespace {

constexpr std::size_t kMostPlaces = 5000, kMostHours = 20'000;
constexpr const char* kHint =
    "give Foreca's JSON: {\"weather\": [{\"s\": \"d200\", \"t\": \"2024-02-05T08:00Z\"}]}";

/// The first of some members that is there and not null.
std::optional<JsonPlace> firstOf(const JsonPlace& place, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys)
    if (auto member = place.ifAny(key); member && !member->isNull()) return member;
  return std::nullopt;
}

std::optional<double> numberOf(const JsonPlace& place, std::initializer_list<std::string_view> keys,
                               double lowest, double highest) {
  const auto member = firstOf(place, keys);
  return member ? std::optional(member->number(lowest, highest)) : std::nullopt;
}

/// As base::utcFromIso, with an offset (+01:00) in place of the Z as well.
std::optional<base::UtcTime> timeFrom(std::string text) {
  std::int64_t offset = 0;
  const std::size_t size = text.size();
  if (size > 16 && text[size - 3] == ':' && (text[size - 6] == '+' || text[size - 6] == '-')) {
    for (const std::size_t at : {size - 5, size - 4, size - 2, size - 1})
      if (text[at] < '0' || text[at] > '9') return std::nullopt;
    offset = std::stoi(text.substr(size - 5, 2)) * 3600 + std::stoi(text.substr(size - 2)) * 60;
    if (text[size - 6] == '-') offset = -offset;
    text.resize(size - 6);
    text += 'Z';
  }
  auto time = base::utcFromIso(text);
  if (time) time->seconds -= offset;
  return time;
}

CodedHour hourOf(const JsonPlace& place) {
  CodedHour hour;
  const auto symbol = firstOf(place, {"s", "symbol"});
  if (!symbol) place.fail("lacks \"s\" (the weather symbol)", kHint);
  const auto known = symbolFrom(symbol->text(40));
  if (!known)
    symbol->fail("is no weather symbol",
                 "give d or n, then cloudiness 0..6, precipitation 0..4, kind 0..2, as d210");
  hour.symbol = *known;
  const auto time = firstOf(place, {"t", "time", "d", "date"});
  if (!time) place.fail("lacks \"t\" (the time)", kHint);
  const auto moment = timeFrom(time->text(40));
  if (!moment) time->fail("is not a time", "give 2024-02-05T08:00Z, 2024-02-05T09:00+01:00 or 2024-02-05");
  hour.time = *moment;
  hour.temperatureC = numberOf(place, {"temp", "temperature", "maxT", "maxTemp"}, -90, 60);
  hour.dewPointC = numberOf(place, {"dewPoint"}, -100, 40);
  if (!hour.dewPointC && hour.temperatureC)
    if (const auto humidity = numberOf(place, {"relHumidity"}, 0, 120))
      hour.dewPointC = dewPointC(*hour.temperatureC, *humidity / 100.0);
  if (!hour.dewPointC) hour.dewPointC = numberOf(place, {"minT", "minTemp"}, -100, 60);
  hour.windFromDegrees = numberOf(place, {"wd", "windDir"}, -360, 720);
  hour.windSpeed = numberOf(place, {"ws", "windSpeed", "maxWindSpeed"}, 0, 150);
  return hour;
}

CodedPlace placeOf(const JsonPlace& root, const std::string& where) {
  CodedPlace place;
  const auto location = firstOf(root, {"location"});
  const JsonPlace& position = location && location->isObject() ? *location : root;
  const auto latitude = numberOf(position, {"lat", "latitude"}, -90, 90),
             longitude = numberOf(position, {"lon", "longitude"}, -360, 360);
  if (latitude && longitude) place.point = {*longitude, *latitude};
  place.elevationMeters = numberOf(position, {"elevation"}, -500, 9000);
  place.name = where;
  const auto list = firstOf(root, {"weather", "forecast", "current"});
  if (!list) root.fail("lacks \"weather\"", kHint);
  if (list->isObject()) {
    place.hours.push_back(hourOf(*list));
    return place;
  }
  const std::size_t count = list->count(1, kMostHours);
  for (std::size_t i = 0; i < count; ++i) place.hours.push_back(hourOf(list->element(i)));
  return place;
}

}  // namespace

std::vector<CodedPlace> readForecaJson(std::string_view text, const std::string& where) {
  const nlohmann::json document = parseJson(text, where);
  const JsonPlace root(document, where, "", kHint);
  std::vector<CodedPlace> places;
  if (!root.isArray()) return {placeOf(root, where)};
  const std::size_t count = root.count(1, kMostPlaces);
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(placeOf(root.element(i), fmt::format("{}, /{}", where, i)));
  return places;
}

}  // namespace cloudgen::input
