// SPDX-License-Identifier: Apache-2.0
#include "cli/input_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "input/catalogue.hpp"

namespace cloudgen::cli {
namespace {

/// Nothing for "first" and "all".
std::optional<base::UtcTime> timeFromText(const std::string& text) {
  if (text == "first" || text == "all") return std::nullopt;
  const auto time = base::utcFromIso(text);
  if (!time)
    throw base::UsageError("--time " + text, "is not an ISO time",
                           "as in --time 2011-01-15T12:00Z, or --time all");
  return time;
}

std::optional<input::Place> placeFromText(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto parts = base::split(text, ',');
  input::Place place;
  double elevation = 0;
  const bool read = (parts.size() == 2 || parts.size() == 3) &&
                    base::parseNumber(parts[0], place.longitudeDegrees) &&
                    base::parseNumber(parts[1], place.latitudeDegrees) &&
                    (parts.size() == 2 || base::parseNumber(parts[2], elevation));
  if (!read || std::abs(place.longitudeDegrees) > 360 || std::abs(place.latitudeDegrees) > 90 ||
      std::abs(elevation) > 9000)
    throw base::UsageError("--at " + text, "is not LONGITUDE,LATITUDE[,ELEVATION]",
                           "as in --at 24.94,60.17,26 (degrees and metres)");
  if (parts.size() == 3) place.elevationMeters = elevation;
  return place;
}

std::optional<std::endian> byteOrderFromText(const std::string& text) {
  if (text.empty() || text == "auto") return std::nullopt;
  if (text == "big") return std::endian::big;
  if (text == "little") return std::endian::little;
  throw base::UsageError("--byte-order " + text, "is not known", "give big, little or auto");
}

}  // namespace

void addInputOptions(CLI::App& options, InputLine& line) {
  options
      .add_option(
          "INPUT", line.inputs,
          "what says something about clouds: GRIB, NetCDF, CDFS II / WWMCA (files or a folder), METAR, "
          "weather codes (JSON), or a described sky (*.sky.json)")
      ->required();
  addReadingOptions(options, line);
}

void addReadingOptions(CLI::App& options, InputLine& line) {
  options.add_option("--time", line.time, "of several: a valid time (ISO), first, or all (build makes a sky that moves)")
      ->capture_default_str();
  options.add_option("--at", line.place,
                     "LONGITUDE,LATITUDE[,ELEVATION] of an input that does not say where it is");
  options.add_option("--byte-order", line.byteOrder,
                     "big, little or auto: of raw binary WWMCA files (default: told by their times)");
  options.add_option("--stations", line.stations, "a table of METAR stations (CSV) besides the built-in one");
}

input::OpenOptions openOptions(const InputLine& line) {
  input::OpenOptions options;
  options.time = timeFromText(line.time);
  options.place = placeFromText(line.place);
  options.byteOrder = byteOrderFromText(line.byteOrder);
  options.stations = line.stations;
  return options;
}

std::unique_ptr<field::Source> openInput(const InputLine& line) {
  return input::open({line.inputs.begin(), line.inputs.end()}, openOptions(line));
}

std::unique_ptr<field::Source> openTyping(const std::string& path, const InputLine& line, base::UtcTime time,
                                          double windowMinutes) {
  input::OpenOptions options = openOptions(line);
  options.time.reset();
  auto typing = input::open({path}, options);
  if (typing->telling() != field::Telling::Layers)
    throw base::InputError("--typing " + path, "is no cloud typing: it holds model levels",
                           "give it as INPUT, and a WWMCA file or folder as --typing");
  const auto& times = typing->info().validTimes;
  const auto away = [&](base::UtcTime other) { return std::abs(other.seconds - time.seconds); };
  const base::UtcTime nearest =
      times.empty() ? typing->info().validTime
                    : *std::min_element(times.begin(), times.end(),
                                        [&](base::UtcTime a, base::UtcTime b) { return away(a) < away(b); });
  if (static_cast<double>(away(nearest)) > 60 * windowMinutes)
    throw base::InputError(
        "--typing " + path,
        fmt::format("is valid at {}, {:.0f} minutes from the model's {}", base::isoText(nearest),
                    static_cast<double>(away(nearest)) / 60, base::isoText(time)),
        fmt::format("give a typing within {:.0f} minutes, or widen --typing-window", windowMinutes));
  if (nearest == typing->info().validTime) return typing;
  options.time = nearest;
  return input::open({path}, options);
}

}  // namespace cloudgen::cli
