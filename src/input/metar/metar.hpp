// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/metar/stations.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input {

/// METAR reports: text in which a station and a day with time stand (and no NUL), or a cache file of
/// aviationweather.gov.
bool isMetar(std::string_view firstBytes);

/// Opens METAR and SPECI reports: bulletins, files by cycle, or cache files. Of each station the last report
/// at or before the wanted time (nothing: the latest of all) counts that tells the sky and is not over 3
/// hours old. The month, which reports do not tell, comes from the file (cache, dated lines, its name), else
/// from the wanted time, else March 2000 is assumed, with a warning. The grid is a lattice over the stations,
/// its cells as wide as the median distance to the nearest other one, within 10 and 100 km (20 km around a
/// single station); a cell takes the layers of the nearest station within one and a half cells, others tell
/// nothing. Throws InputError: no report that can be read, no known station, no such time.
std::unique_ptr<field::Source> openMetar(const std::vector<std::filesystem::path>& files,
                                         const OpenOptions& options);

struct MetarText {
  std::string name;  ///< of the file; may hold the date
  std::string text;
};

/// The same from texts and a table of stations.
std::unique_ptr<field::Source> skyOfMetars(const std::vector<MetarText>& texts, const StationTable& stations,
                                           const OpenOptions& options);

}  // namespace cloudgen::input
