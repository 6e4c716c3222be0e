// SPDX-License-Identifier: Apache-2.0
#include "input/metar/cache.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "input/described/json_place.hpp"

namespace cloudgen::input {
namespace {

/// The members of a report that every form has, by whatever name.
struct Fields {
  std::string_view raw, time, latitude, longitude, elevation;
};

CachedReport reportFrom(const Fields& fields, std::size_t line) {
  CachedReport report{std::string(fields.raw), line, base::utcFromIso(fields.time), std::nullopt};
  Station station;
  double elevation = 0;
  if (base::parseNumber(fields.latitude, station.point.latitudeDegrees) &&
      base::parseNumber(fields.longitude, station.point.longitudeDegrees) &&
      std::abs(station.point.latitudeDegrees) <= 90 && std::abs(station.point.longitudeDegrees) <= 360) {
    if (base::parseNumber(fields.elevation, elevation) && elevation > -500 && elevation < 9000)
      station.elevationMeters = elevation;
    report.station = station;
  }
  return report;
}

/// Lines with their numbers.
template <class Visit>
void eachLine(std::string_view text, const Visit& visit) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    if (row.ends_with('\r')) row.remove_suffix(1);
    visit(row, line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::vector<CachedReport> fromCsv(std::string_view text) {
  std::vector<CachedReport> reports;
  std::vector<std::string> heading;
  eachLine(text, [&](std::string_view row, std::size_t line) {
    if (heading.empty()) {
      if (row.starts_with("raw_text,")) heading = base::split(row, ',');
      return;
    }
    const std::vector<std::string> parts = base::split(row, ',');
    const auto field = [&](std::string_view name) -> std::string_view {
      const auto at = std::find(heading.begin(), heading.end(), name) - heading.begin();
      return static_cast<std::size_t>(at) < parts.size()
                 ? std::string_view(parts[static_cast<std::size_t>(at)])
                 : std::string_view();
    };
    const Fields fields{field("raw_text"), field("observation_time"), field("latitude"), field("longitude"),
                        field("elevation_m")};
    if (!fields.raw.empty()) reports.push_back(reportFrom(fields, line));
  });
  return reports;
}

std::string_view between(std::string_view text, std::string_view open, std::string_view close) {
  const std::size_t start = text.find(open);
  if (start == std::string_view::npos) return {};
  const std::size_t end = text.find(close, start + open.size());
  return end == std::string_view::npos ? std::string_view()
                                       : text.substr(start + open.size(), end - start - open.size());
}

std::vector<CachedReport> fromXml(std::string_view text) {
  std::vector<CachedReport> reports;
  std::size_t line = 1, counted = 0;
  for (std::size_t at = 0; (at = text.find("<METAR>", at)) != std::string_view::npos;) {
    line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    counted = at;
    const std::size_t end = text.find("</METAR>", at);
    if (end == std::string_view::npos) break;
    const std::string_view element = text.substr(at, end - at);
    const auto field = [&](const std::string& name) {
      return between(element, "<" + name + ">", "</" + name + ">");
    };
    const Fields fields{field("raw_text"), field("observation_time"), field("latitude"), field("longitude"),
                        field("elevation_m")};
    if (!fields.raw.empty()) reports.push_back(reportFrom(fields, line));
    at = end;
  }
  return reports;
}

std::vector<CachedReport> fromJson(std::string_view text, const std::string& where) {
  const nlohmann::json document = parseJson(text, where);
  std::vector<CachedReport> reports;
  if (!document.is_array()) return reports;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const nlohmann::json& element = document[i];
    if (!element.is_object()) continue;
    const auto number = [&](const char* name) {
      const auto member = element.find(name);
      return member != element.end() && member->is_number() ? std::optional(member->get<double>())
                                                            : std::nullopt;
    };
    const auto raw = element.find("rawOb");
    if (raw == element.end() || !raw->is_string()) continue;
    CachedReport report{raw->get<std::string>(), i + 1, std::nullopt, std::nullopt};
    if (const auto seconds = number("obsTime"); seconds && *seconds > 0 && *seconds < 4e9)
      report.time = base::UtcTime{static_cast<std::int64_t>(*seconds)};
    const auto latitude = number("lat"), longitude = number("lon"), elevation = number("elev");
    if (latitude && longitude && std::abs(*latitude) <= 90 && std::abs(*longitude) <= 360) {
      report.station = Station{{*longitude, *latitude}, std::nullopt};
      if (elevation && *elevation > -500 && *elevation < 9000) report.station->elevationMeters = elevation;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

enum class Form { None, Csv, Xml, Json };

Form formOf(std::string_view text) {
  const std::string_view start = text.substr(0, 4096);
  const auto has = [&](std::string_view part) { return start.find(part) != std::string_view::npos; };
  if (has("raw_text,")) return Form::Csv;
  if (has("<METAR>")) return Form::Xml;
  return has("\"rawOb\"") ? Form::Json : Form::None;
}

}  // namespace

bool isMetarCache(std::string_view text) { return formOf(text) != Form::None; }

std::vector<CachedReport> readMetarCache(std::string_view text, const std::string& where) {
  switch (formOf(text)) {
    case Form::Csv:
      return fromCsv(text);
    case Form::Xml:
      return fromXml(text);
    case Form::Json:
      return fromJson(text, where);
    case Form::None:
      break;
  }
  return {};
}

}  // namespace cloudgen::input
