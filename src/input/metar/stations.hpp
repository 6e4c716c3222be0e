// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "field/grid.hpp"

namespace cloudgen::input {

struct Station {
  field::GeoPoint point;
  std::optional<double> elevationMeters;
};

using StationTable = std::map<std::string, Station, std::less<>>;

/// Adds the lines "icao,latitude,longitude,elevation_m" of a table; those already there are replaced. Lines
/// that begin with # and the heading are passed over; the elevation may be empty. Throws InputError that
/// names the line.
void addStations(StationTable& table, std::string_view text, const std::string& where);

/// templates/stations.csv, and over it `file` unless that is empty. Throws InputError.
StationTable readStations(const std::filesystem::path& file);

/// The elevation of the nearest station within 100 km that has one.
std::optional<double> elevationNear(const StationTable& table, const field::GeoPoint& point);

}  // namespace cloudgen::input
