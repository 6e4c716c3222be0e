// SPDX-License-Identifier: Apache-2.0
#include "input/metar/stations.hpp"

#include <fmt/format.h>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "input/point/point_source.hpp"

namespace cloudgen::input {

void addStations(StationTable& table, std::string_view text, const std::string& where) {
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (row.ends_with('\r')) row.remove_suffix(1);
    if (row.empty() || row[0] == '#' || row.starts_with("icao")) continue;
    const std::vector<std::string> parts = base::split(row, ',');
    Station station;
    double elevation = 0;
    const bool readable = parts.size() >= 3 && !parts[0].empty() && parts[0].size() <= 8 &&
                          base::parseNumber(parts[1], station.point.latitudeDegrees) &&
                          base::parseNumber(parts[2], station.point.longitudeDegrees) &&
                          std::abs(station.point.latitudeDegrees) <= 90 &&
                          std::abs(station.point.longitudeDegrees) <= 360 &&
                          (parts.size() < 4 || parts[3].empty() ||
                           (base::parseNumber(parts[3], elevation) && elevation > -500 && elevation < 9000));
    if (!readable)
      throw base::InputError(fmt::format("{}, line {}", where, line), "is no station",
                             "give icao,latitude,longitude,elevation_m as in KMIA,25.7933,-80.3167,2");
    if (parts.size() >= 4 && !parts[3].empty()) station.elevationMeters = elevation;
    table[parts[0]] = station;
  }
}

StationTable readStations(const std::filesystem::path& file) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20;
  StationTable table;
  const std::filesystem::path own = base::dataDir() / "templates" / "stations.csv";
  addStations(table, base::readFile(own, kMostBytes), own.string());
  if (!file.empty()) addStations(table, base::readFile(file, kMostBytes), file.string());
  return table;
}

std::optional<double> elevationNear(const StationTable& table, const field::GeoPoint& point) {
  double nearest = 100'000;
  std::optional<double> elevation;
  for (const auto& [name, station] : table) {
    if (!station.elevationMeters) continue;
    const double meters = distanceMeters(point, station.point);
    if (meters >= nearest) continue;
    nearest = meters;
    elevation = station.elevationMeters;
  }
  return elevation;
}

}  // namespace cloudgen::input
