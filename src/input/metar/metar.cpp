// SPDX-License-Identifier: Apache-2.0
#include "input/metar/metar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/frame.hpp"
#include "input/metar/bulletin.hpp"
#include "input/metar/cache.hpp"
#include "input/metar/metar_sky.hpp"
#include "input/metar/report.hpp"
#include "input/point/point_source.hpp"
#include "input/point/valid_time.hpp"
#include "input/weather_code/symbol.hpp"

namespace cloudgen::input {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;
constexpr std::int64_t kOldestSeconds = 3 * 3600;
constexpr double kReachCells = 1.5;
constexpr double kStormSquareMeters = 150e6, kCongestusSquareMeters = 9e6, kSmallCellSquareMeters = 2000e6;

struct Observation {
  MetarReport report;
  base::UtcTime time;
  Station station;
};

/// Everything that the files hold, and what was wrong with it.
struct Gathering {
  std::vector<Observation> observations;
  std::size_t unreadable = 0, unreadableLine = 0, noSky = 0;
  std::vector<std::string> cutOff;  ///< where reports break off
  std::set<std::string> unknown, withoutElevation;
  bool monthAssumed = false;
};

/// The day and time of a report in the month that brings it nearest to `near`; the month of the assumption
/// has 31 days.
base::UtcTime timeOf(const MetarReport& report, std::optional<base::UtcTime> near) {
  using namespace std::chrono;
  if (!near) return base::utcFromCivil(2000, 3, report.day, report.hour, report.minute);
  const year_month_day date{floor<days>(sys_seconds{seconds{near->seconds}})};
  std::optional<base::UtcTime> nearest;
  for (int shift = -2; shift <= 2; ++shift) {
    const year_month month = date.year() / date.month() + months{shift};
    if (!(month / report.day).ok()) continue;
    const base::UtcTime time = base::utcFromCivil(static_cast<int>(month.year()),
                                                  static_cast<int>(static_cast<unsigned>(month.month())),
                                                  report.day, report.hour, report.minute);
    if (!nearest || std::abs(time.seconds - near->seconds) < std::abs(nearest->seconds - near->seconds))
      nearest = time;
  }
  return *nearest;
}

void gather(Gathering& all, const RawReport& raw, std::optional<base::UtcTime> exact,
            std::optional<base::UtcTime> near, std::optional<Station> station, const StationTable& stations) {
  const auto report = decodeMetar(raw.groups);
  if (!report) {
    if (all.unreadable++ == 0) all.unreadableLine = raw.line;
    return;
  }
  if (!station) {
    const auto known = stations.find(report->station);
    if (known == stations.end()) {
      all.unknown.insert(report->station);
      return;
    }
    station = known->second;
  }
  if (!report->skyTold && report->weather.fogCover == 0) {
    ++all.noSky;
    return;
  }
  if (!exact && !near) all.monthAssumed = true;
  station->point.longitudeDegrees = base::wrappedLongitude(station->point.longitudeDegrees);
  all.observations.push_back({*report, exact ? *exact : timeOf(*report, near), *station});
}

Gathering gatherAll(const std::vector<MetarText>& texts, const StationTable& stations,
                    const OpenOptions& options) {
  Gathering all;
  for (const MetarText& file : texts) {
    const auto named = dateInName(std::filesystem::path(file.name).filename().string());
    if (isMetarCache(file.text)) {
      for (const CachedReport& cached : readMetarCache(file.text, file.name)) {
        std::vector<RawReport> raw = findReports(cached.raw);
        if (raw.empty()) raw.push_back({});
        raw.front().line = cached.line;
        gather(all, raw.front(), cached.time, named ? named : options.time, cached.station, stations);
      }
      continue;
    }
    std::vector<RawReport> reports = findReports(file.text);
    // Where reports end with "=", a last one that does not was cut off: half a group is another group.
    const auto ends = [](const RawReport& raw) { return raw.ended; };
    if (!reports.empty() && !reports.back().ended && std::any_of(reports.begin(), reports.end(), ends)) {
      all.cutOff.push_back(fmt::format("{}, line {}", file.name, reports.back().line));
      reports.pop_back();
    }
    for (const RawReport& raw : reports)
      gather(all, raw, std::nullopt, raw.near ? raw.near : (named ? named : options.time), std::nullopt,
             stations);
  }
  return all;
}

/// The last of each station at or before `wanted`; of two at one time the later in the input (a correction).
std::vector<const Observation*> lastOfEach(const std::vector<Observation>& observations,
                                           base::UtcTime wanted) {
  std::map<std::string_view, const Observation*> last;
  for (const Observation& each : observations) {
    if (each.time > wanted || wanted.seconds - each.time.seconds > kOldestSeconds) continue;
    const Observation*& known = last[each.report.station];
    if (!known || each.time >= known->time) known = &each;
  }
  std::vector<const Observation*> out;
  for (const auto& [name, each] : last) out.push_back(each);
  return out;
}

void warn(field::SourceInfo& info, const Gathering& all) {
  if (all.monthAssumed)
    info.warnings.push_back(
        {"metar_month_assumed",
         "the reports tell no month: March 2000 is assumed; put the date in the file's name "
         "(metar-2024-02-08.txt) or give --time"});
  if (!all.unknown.empty())
    info.warnings.push_back(
        {"unknown_station", fmt::format("{} station{} in no table ({}{}): give their places with --stations",
                                        all.unknown.size(), all.unknown.size() == 1 ? " is" : "s are",
                                        *all.unknown.begin(), all.unknown.size() > 1 ? ", ..." : "")});
  if (all.unreadable > 0)
    info.warnings.push_back(
        {"unreadable_report", fmt::format("{} report{} cannot be read, the first at line {}", all.unreadable,
                                          all.unreadable == 1 ? "" : "s", all.unreadableLine)});
  if (!all.cutOff.empty())
    info.warnings.push_back(
        {"report_cut_off", fmt::format("the text breaks off in its last report, which is left out ({})",
                                       fmt::join(all.cutOff, "; "))});
  if (all.noSky > 0)
    info.warnings.push_back(
        {"sky_not_reported",
         fmt::format("{} report{} nothing of the sky and {} passed over", all.noSky,
                     all.noSky == 1 ? " tells" : "s tell", all.noSky == 1 ? "is" : "are")});
}

Air airOf(const Observation& observation) {
  const MetarReport& report = observation.report;
  Air air;
  air.latitudeDegrees = observation.station.point.latitudeDegrees;
  air.surfaceMeters = observation.station.elevationMeters.value_or(0.0);
  air.temperatureC = report.temperatureC.value_or(15.0);
  air.windFromDegrees = report.windFromDegrees.value_or(0.0);
  air.windSpeed = report.windFromDegrees ? report.windSpeed.value_or(0.0) : 0.0;
  return air;
}

/// Clouds that stand in a cell for what was seen over it, where the cover would stand for less than one, or
/// for so few that chance might leave them out: one storm or congestus; a quarter of a sheet an element.
void countFew(field::StatedLayer& layer, double cellSquareMeters) {
  const double covers = layer.coverFraction * cellSquareMeters;
  switch (*layer.genus) {
    case base::Genus::Cumulonimbus:
      if (covers < kStormSquareMeters) layer.cloudCount = 1;
      break;
    case base::Genus::Cumulus:
      if (layer.topMeters - layer.baseMeters > 2500 && covers < kCongestusSquareMeters) layer.cloudCount = 1;
      break;
    case base::Genus::Cirrus:
    case base::Genus::Cirrostratus:
    case base::Genus::Altostratus:
    case base::Genus::Nimbostratus:
      if (cellSquareMeters < kSmallCellSquareMeters)
        layer.cloudCount = static_cast<int>(std::ceil(4 * layer.coverFraction));
      break;
    default:
      break;
  }
}

/// Fills what the table does not know by the nearest station that it does.
void addElevations(std::vector<const Observation*>& chosen, std::vector<Observation>& filled,
                   const StationTable& stations, field::SourceInfo& info) {
  std::size_t unknown = 0;
  for (const Observation* each : chosen) {
    filled.push_back(*each);
    if (each->station.elevationMeters) continue;
    ++unknown;
    filled.back().station.elevationMeters = elevationNear(stations, each->station.point).value_or(0.0);
  }
  if (unknown > 0)
    info.warnings.push_back(
        {"station_elevation_unknown",
         fmt::format(
             "{} station{} no elevation: that of the nearest known one within 100 km is taken, else 0 m",
             unknown, unknown == 1 ? " has" : "s have")});
}

}  // namespace

bool isMetar(std::string_view firstBytes) {
  if (firstBytes.find('\0') != std::string_view::npos) return false;
  return isMetarCache(firstBytes) || !findReports(firstBytes).empty();
}

std::unique_ptr<field::Source> skyOfMetars(const std::vector<MetarText>& texts, const StationTable& stations,
                                           const OpenOptions& options) {
  const Gathering all = gatherAll(texts, stations, options);
  const std::string& where = texts.front().name;
  if (all.observations.empty()) {
    if (!all.unknown.empty())
      throw base::InputError(where,
                             fmt::format("has reports of unknown stations only ({})", *all.unknown.begin()),
                             "give a table icao,latitude,longitude,elevation_m with --stations");
    if (all.unreadable > 0)
      throw base::InputError(fmt::format("{}, line {}", where, all.unreadableLine), "is no METAR report",
                             "give reports as in \"KMIA 081353Z 16032KT 10SM FEW035 25/19 A3003=\"");
    throw base::InputError(where, "has no METAR report that tells the sky", "give METAR or SPECI reports");
  }
  field::SourceInfo info;
  for (const MetarText& file : texts) info.files.push_back(file.name);
  info.format = "METAR";
  info.model = "surface observations";
  for (const Observation& each : all.observations) info.validTimes.push_back(each.time);
  info.validTimes = ascending(std::move(info.validTimes));
  info.validTime = options.time.value_or(info.validTimes.back());
  std::vector<const Observation*> chosen = lastOfEach(all.observations, info.validTime);
  if (chosen.empty()) failForTime(where, info.validTime, info.validTimes);
  warn(info, all);
  std::vector<Observation> observations;
  addElevations(chosen, observations, stations, info);
  info.fields = {fmt::format("cloud groups of {} stations: cover, base, CB and TCU", observations.size()),
                 "present weather, temperature and dew point: genus, depth", "visibility: thickness of fog",
                 "wind at 10 m: by the power law (1/7) at cloud level"};
  info.missing = {"tops: depths usual for the genus", "optical depth: the genus's usual extinction",
                  "clouds above a full cover, and above 12,000 ft where an automatic station reports CLR"};

  std::vector<field::GeoPoint> points;
  for (const Observation& each : observations) points.push_back(each.station.point);
  const double spacing = medianSpacingMeters(points);
  const double side = spacing > 0 ? std::clamp(spacing, 10'000.0, 100'000.0) : kSkySideMeters;
  const field::Grid grid = latticeOver(points, side);
  const auto near = pointsNear(grid, points, kReachCells * side);
  double meanSurface = 0;
  for (const Observation& each : observations)
    meanSurface += *each.station.elevationMeters / static_cast<double>(observations.size());
  std::vector<float> surface(grid.size(), static_cast<float>(meanSurface));
  std::vector<field::StatedLayer> layers;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
    if (near[cell].empty()) continue;
    const Observation& seen = observations[near[cell].front().point];
    const Air air = airOf(seen);
    surface[cell] = static_cast<float>(air.surfaceMeters);
    const bool day = sunElevationDegrees(info.validTime, seen.station.point) > 0;
    const auto age = static_cast<std::uint16_t>((info.validTime.seconds - seen.time.seconds) / 60);
    for (field::StatedLayer layer : layersOf(seen.report, air, day)) {
      layer.cell = cell;
      layer.ageMinutes = age;
      countFew(layer, field::cellAreaSquareMeters(grid, cell));
      layers.push_back(layer);
    }
  }
  return std::make_unique<PointSource>(std::move(info), grid, std::move(layers), std::move(surface));
}

std::unique_ptr<field::Source> openMetar(const std::vector<std::filesystem::path>& files,
                                         const OpenOptions& options) {
  std::vector<MetarText> texts;
  for (const std::filesystem::path& file : files)
    texts.push_back({file.string(), base::readFile(file, kMostBytes)});
  return skyOfMetars(texts, readStations(options.stations), options);
}

}  // namespace cloudgen::input
