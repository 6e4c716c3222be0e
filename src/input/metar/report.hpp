// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::input {

/// A cloud group of a report. Covers are fractions of the sky, as reported: what this layer and all below
/// hide.
struct CloudGroup {
  double cover = 0;                      ///< middle of the oktas: FEW 1.5, SCT 3.5, BKN 6, OVC and VV 8
  double mostCover = 0;                  ///< their upper end: 2, 4, 7, 8
  std::optional<double> heightMeters;    ///< above the station
  bool storm = false, towering = false;  ///< CB, TCU
  bool verticalVisibility = false;
  std::optional<base::Genus> genus;  ///< from a remark
};

/// Present weather, as far as it bears on clouds; what is only in the vicinity or past does not count.
struct PresentWeather {
  double fogCover = 0;  ///< FG 1, PRFG 0.5, BCFG 0.3
  bool drizzle = false, rain = false, showers = false,
       thunder = false;  ///< rain: any steady fall of RA, SN, PL
  int intensity = 0;     ///< -1 light, 1 heavy
};

/// A METAR or SPECI (WMO FM 15, FM 16; FMH-1 of the United States).
struct MetarReport {
  std::string station;
  int day = 0, hour = 0, minute = 0;
  bool skyTold = false;  ///< clouds, or that there are none
  std::vector<CloudGroup> clouds;
  PresentWeather weather;
  std::optional<double> windFromDegrees, windSpeed;  ///< m/s; no direction when variable
  std::optional<double> visibilityMeters, temperatureC, dewPointC;
};

/// Whether two groups begin a report: a station and a day and time ("KMIA", "081403Z").
bool beginsReport(std::string_view station, std::string_view time);

/// Decodes the groups of a report, station first. Groups that it does not know are passed over; forecasts
/// (TEMPO ...) and remarks end it, but for a Canadian remark of cloud types ("SC5AC2"). Nothing if the time
/// is none, or the report is missing (NIL).
std::optional<MetarReport> decodeMetar(std::span<const std::string_view> groups);

}  // namespace cloudgen::input
