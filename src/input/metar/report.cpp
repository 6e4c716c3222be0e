// SPDX-License-Identifier: Apache-2.0
#include "input/metar/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cloudgen::input {
namespace {

using base::Genus;

constexpr double kFoot = 0.3048, kKnot = 1852.0 / 3600.0, kStatuteMile = 1609.344;

bool allDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Of a short text of digits.
int numberOf(std::string_view digits) {
  int number = 0;
  for (const char c : digits) number = 10 * number + (c - '0');
  return number;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

bool isWind(std::string_view group, MetarReport& report) {
  double unit = 0;
  for (const auto& [name, factor] :
       {std::pair<std::string_view, double>{"KT", kKnot}, {"MPS", 1.0}, {"KMH", 1 / 3.6}})
    if (group.ends_with(name)) {
      unit = factor;
      group.remove_suffix(name.size());
      break;
    }
  if (unit == 0 || group.size() < 5) return false;
  const std::string_view direction = group.substr(0, 3);
  std::string_view speed = group.substr(3, group.find('G') == std::string_view::npos
                                               ? std::string_view::npos
                                               : group.find('G') - std::min<std::size_t>(group.find('G'), 3));
  take(speed, "P");
  if (!allDigits(speed) || speed.size() > 3) return direction == "///";
  report.windSpeed = unit * numberOf(speed);
  if (allDigits(direction) && numberOf(direction) <= 360) report.windFromDegrees = numberOf(direction);
  return true;
}

/// Miles of "10SM", "1/2SM", "M1/4SM", "P6SM"; `whole` is the group before, of "1 1/2SM".
std::optional<double> milesOf(std::string_view group, std::string_view whole) {
  if (!group.ends_with("SM")) return std::nullopt;
  group.remove_suffix(2);
  if (!take(group, "M")) take(group, "P");
  const std::size_t slash = group.find('/');
  if (slash == std::string_view::npos)
    return allDigits(group) && group.size() <= 3 ? std::optional<double>(numberOf(group)) : std::nullopt;
  const std::string_view over = group.substr(0, slash), under = group.substr(slash + 1);
  if (!allDigits(over) || !allDigits(under) || over.size() > 2 || under.size() > 2 || numberOf(under) == 0)
    return std::nullopt;
  const double full = allDigits(whole) && whole.size() <= 2 ? numberOf(whole) : 0;
  return full + static_cast<double>(numberOf(over)) / numberOf(under);
}

bool isVisibility(std::string_view group, std::string_view before, MetarReport& report) {
  if (const auto miles = milesOf(group, before)) {
    report.visibilityMeters = *miles * kStatuteMile;
    return true;
  }
  if (group.size() < 4 || !allDigits(group.substr(0, 4))) return false;
  const std::string_view side = group.substr(4);
  if (!side.empty() && side != "NDV" && side.find_first_not_of("NESW") != std::string_view::npos)
    return false;
  // The first is the prevailing one; a second with a direction is the least.
  if (!report.visibilityMeters)
    report.visibilityMeters = group.starts_with("9999") ? 10'000 : numberOf(group.substr(0, 4));
  return true;
}

bool isWeather(std::string_view group, PresentWeather& weather) {
  static constexpr std::array<std::string_view, 30> kCodes{
      "MI", "BC", "PR", "DR", "BL", "SH", "TS", "FZ", "DZ", "RA", "SN", "SG", "IC", "PL", "GR",
      "GS", "UP", "BR", "FG", "FU", "VA", "DU", "SA", "HZ", "PY", "PO", "SQ", "FC", "SS", "DS"};
  const int intensity = take(group, "-") ? -1 : (take(group, "+") ? 1 : 0);
  const bool vicinity = take(group, "VC");
  if (group.empty() || group.size() % 2 != 0 || group.size() > 10) return false;
  const auto has = [&](std::string_view code) {
    for (std::size_t i = 0; i < group.size(); i += 2)
      if (group.substr(i, 2) == code) return true;
    return false;
  };
  for (std::size_t i = 0; i < group.size(); i += 2)
    if (std::find(kCodes.begin(), kCodes.end(), group.substr(i, 2)) == kCodes.end()) return false;
  if (vicinity) return true;
  const bool falls = has("RA") || has("SN") || has("PL") || has("UP") || has("GS") || has("GR");
  const bool blown = has("BL") || has("DR");
  if (has("TS"))
    weather.thunder = true;
  else if (has("SH"))
    weather.showers = true;
  else if (falls && !blown)
    weather.rain = true;
  if (has("DZ") || has("SG")) weather.drizzle = true;
  if (has("FG") && !has("MI"))
    weather.fogCover = std::max(weather.fogCover, has("BC") ? 0.3 : (has("PR") ? 0.5 : 1.0));
  if (falls) weather.intensity = intensity;
  return true;
}

bool isCloud(std::string_view group, MetarReport& report) {
  for (const std::string_view none : {"SKC", "CLR", "NSC", "NCD", "CAVOK"})
    if (group == none) return report.skyTold = true;
  struct Amount {
    std::string_view name;
    double oktas, most;
  };
  static constexpr std::array<Amount, 6> kAmounts{
      {{"FEW", 1.5, 2}, {"SCT", 3.5, 4}, {"BKN", 6, 7}, {"OVC", 8, 8}, {"VV", 8, 8}, {"///", 1.5, 2}}};
  for (const Amount& amount : kAmounts) {
    std::string_view rest = group;
    if (!take(rest, amount.name) || rest.size() < 3) continue;
    CloudGroup cloud;
    cloud.cover = amount.oktas / 8;
    cloud.mostCover = amount.most / 8;
    cloud.verticalVisibility = amount.name == "VV";
    const std::string_view height = rest.substr(0, 3), kind = rest.substr(3);
    if (allDigits(height))
      cloud.heightMeters = std::max(15.0, 100.0 * numberOf(height) * kFoot);
    else if (height != "///")
      return false;
    cloud.storm = kind == "CB";
    cloud.towering = kind == "TCU";
    if (!kind.empty() && kind != "///" && !cloud.storm && !cloud.towering) return false;
    // An amount that the sensor could not tell is worth a cloud only where it saw a storm.
    if (amount.name != "///" || cloud.storm || cloud.towering) {
      report.skyTold = true;
      if (report.clouds.size() < 12) report.clouds.push_back(cloud);
    }
    return true;
  }
  return false;
}

std::optional<double> degreesOf(std::string_view text) {
  const bool below = take(text, "M");
  if (text.size() != 2 || !allDigits(text)) return std::nullopt;
  return below ? -numberOf(text) : numberOf(text);
}

bool isTemperature(std::string_view group, MetarReport& report) {
  const std::size_t slash = group.find('/');
  if (slash == std::string_view::npos || report.temperatureC) return false;
  report.temperatureC = degreesOf(group.substr(0, slash));
  if (report.temperatureC) report.dewPointC = degreesOf(group.substr(slash + 1));
  return report.temperatureC.has_value();
}

/// "SC5AC2": cloud types and their oktas, upwards, one for each cloud group.
void readCloudRemark(std::string_view remark, std::vector<CloudGroup>& clouds) {
  static constexpr std::array<std::pair<std::string_view, Genus>, 14> kTypes{{{"CI", Genus::Cirrus},
                                                                              {"CC", Genus::Cirrocumulus},
                                                                              {"CS", Genus::Cirrostratus},
                                                                              {"ACC", Genus::Altocumulus},
                                                                              {"AC", Genus::Altocumulus},
                                                                              {"AS", Genus::Altostratus},
                                                                              {"NS", Genus::Nimbostratus},
                                                                              {"SC", Genus::Stratocumulus},
                                                                              {"ST", Genus::Stratus},
                                                                              {"SF", Genus::Stratus},
                                                                              {"CU", Genus::Cumulus},
                                                                              {"CF", Genus::Cumulus},
                                                                              {"TCU", Genus::Cumulus},
                                                                              {"CB", Genus::Cumulonimbus}}};
  std::vector<Genus> types;
  while (!remark.empty()) {
    const auto type = std::find_if(kTypes.begin(), kTypes.end(),
                                   [&](const auto& each) { return take(remark, each.first); });
    if (type == kTypes.end() || remark.empty() || remark[0] < '0' || remark[0] > '8') return;
    remark.remove_prefix(1);
    types.push_back(type->second);
  }
  if (types.size() != clouds.size()) return;
  for (std::size_t i = 0; i < types.size(); ++i) clouds[i].genus = types[i];
}

}  // namespace

bool beginsReport(std::string_view station, std::string_view time) {
  const auto letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto sign = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
  return station.size() == 4 && letter(station[0]) && std::all_of(station.begin(), station.end(), sign) &&
         time.size() == 7 && time[6] == 'Z' && allDigits(time.substr(0, 6));
}

std::optional<MetarReport> decodeMetar(std::span<const std::string_view> groups) {
  if (groups.size() < 2 || !beginsReport(groups[0], groups[1])) return std::nullopt;
  MetarReport report;
  report.station = groups[0];
  report.day = numberOf(groups[1].substr(0, 2));
  report.hour = numberOf(groups[1].substr(2, 2));
  report.minute = numberOf(groups[1].substr(4, 2));
  if (report.day < 1 || report.day > 31 || report.hour > 23 || report.minute > 59) return std::nullopt;
  for (std::size_t i = 2; i < groups.size(); ++i) {
    const std::string_view group = groups[i];
    if (group == "NIL") return std::nullopt;
    if (group == "RMK") {
      if (i + 1 < groups.size()) readCloudRemark(groups[i + 1], report.clouds);
      break;
    }
    if (group == "TEMPO" || group == "BECMG" || group == "NOSIG") break;
    if (group == "CAVOK") report.visibilityMeters = 10'000;
    isWind(group, report) || isVisibility(group, groups[i - 1], report) || isCloud(group, report) ||
        isTemperature(group, report) || isWeather(group, report.weather);
  }
  return report;
}

}  // namespace cloudgen::input
