// SPDX-License-Identifier: Apache-2.0
#include "input/metar/metar_sky.hpp"

#include <algorithm>

namespace cloudgen::input {
namespace {

using base::Genus;

constexpr double kMostStormCover = 0.375, kBroken = 5.0 / 8;

/// A group on its way to a layer.
struct Draft {
  CloudGroup group;
  double cover = 0;   ///< its own
  double height = 0;  ///< of the base above the station
  Genus genus{};

  bool low() const { return height < kMiddleEtageMeters; }
};

double missingHeight(const MetarReport& report) {
  if (report.temperatureC && report.dewPointC)
    return condensationMeters(*report.temperatureC, *report.dewPointC);
  return 1000;
}

/// A report of thunder or showers that names no such cloud (automatic stations do not) has one all the same.
void nameTowers(std::vector<Draft>& drafts, const PresentWeather& weather) {
  if (!weather.thunder && !weather.showers) return;
  for (const Draft& draft : drafts)
    if (draft.group.storm || (draft.group.towering && !weather.thunder)) return;
  for (Draft& draft : drafts)
    if (draft.low() && !draft.group.verticalVisibility) {
      (weather.thunder ? draft.group.storm : draft.group.towering) = true;
      return;
    }
}

Genus genusOf(const Draft& draft, const MetarReport& report, const Air& air, bool day) {
  const PresentWeather& weather = report.weather;
  const CloudGroup& group = draft.group;
  if (group.verticalVisibility)
    return weather.rain && weather.fogCover == 0 ? Genus::Nimbostratus : Genus::Fog;
  if (group.storm) return Genus::Cumulonimbus;
  if (group.towering) return Genus::Cumulus;
  if (group.genus) return *group.genus;
  if (weather.fogCover > 0 && draft.height < 60) return Genus::Fog;
  const bool broken = group.cover >= kBroken;
  const double spread =
      report.temperatureC && report.dewPointC ? *report.temperatureC - *report.dewPointC : 5.0;
  if (draft.low()) {
    if (broken && weather.rain) return Genus::Nimbostratus;
    if (broken) return draft.height < 450 || weather.drizzle ? Genus::Stratus : Genus::Stratocumulus;
    if (draft.height < 300 && spread < 2) return Genus::Stratus;
    return day && spread >= 2 ? Genus::Cumulus : Genus::Stratocumulus;
  }
  if (draft.height < highEtageMeters(air.latitudeDegrees)) {
    if (group.cover < 1) return Genus::Altocumulus;
    return weather.rain && draft.height < 3000 ? Genus::Nimbostratus : Genus::Altostratus;
  }
  return broken ? Genus::Cirrostratus : Genus::Cirrus;
}

double depthOf(const Draft& draft, const MetarReport& report, const Air& air, double base) {
  switch (draft.genus) {
    case Genus::Fog:
      return draft.group.verticalVisibility ? std::clamp(2 * draft.height, 60.0, 400.0) : 150;
    case Genus::Stratus:
      return 300;
    case Genus::Stratocumulus:
      return 450;
    case Genus::Cumulus:
      if (draft.group.towering) return std::clamp(heightOfMeters(air, -12) - base, 3000.0, 5000.0);
      return draft.group.cover < 0.25 ? 700 : (draft.group.cover < 0.5 ? 1100 : 1400);
    case Genus::Cumulonimbus:
      return stormTopMeters(air, base) - base;
    case Genus::Nimbostratus:
      return 3500 + 1000 * report.weather.intensity;
    case Genus::Altocumulus:
    case Genus::Cirrocumulus:
      return 400;
    case Genus::Altostratus:
      return 1500;
    case Genus::Cirrus:
    case Genus::Cirrostratus:
      break;
  }
  return 1000;
}

void thickenFog(field::StatedLayer& layer, const MetarReport& report) {
  if (!report.visibilityMeters) return;
  const double extinction = 3.912 / std::max(50.0, *report.visibilityMeters);
  layer.opticalDepth =
      static_cast<float>(std::clamp(extinction * (layer.topMeters - layer.baseMeters), 0.3, 30.0));
}

}  // namespace

std::vector<double> ownCovers(const std::vector<CloudGroup>& groups) {
  std::vector<double> covers;
  double below = 0;
  for (const CloudGroup& group : groups) {
    if (below >= 1) {
      covers.push_back(0);
      continue;
    }
    double upTo = group.cover;
    if (upTo <= below && below <= group.mostCover) upTo = std::min(below + 0.125, group.mostCover);
    if (upTo > below) {
      covers.push_back((upTo - below) / (1 - below));
      below = upTo;
    } else {
      covers.push_back(group.mostCover < below ? group.cover : 0.125);
    }
  }
  return covers;
}

std::vector<field::StatedLayer> layersOf(const MetarReport& report, const Air& air, bool day) {
  const std::vector<double> covers = ownCovers(report.clouds);
  std::vector<Draft> drafts;
  for (std::size_t i = 0; i < report.clouds.size(); ++i) {
    const CloudGroup& group = report.clouds[i];
    const double unknown = group.verticalVisibility ? 60.0 : missingHeight(report);
    if (covers[i] > 0) drafts.push_back({group, covers[i], group.heightMeters.value_or(unknown)});
  }
  std::stable_sort(drafts.begin(), drafts.end(),
                   [](const Draft& a, const Draft& b) { return a.height < b.height; });
  nameTowers(drafts, report.weather);
  for (Draft& draft : drafts) draft.genus = genusOf(draft, report, air, day);

  std::vector<field::StatedLayer> layers;
  const auto hasFog = [](const Draft& draft) { return draft.genus == Genus::Fog; };
  const bool foggy = report.weather.fogCover > 0 && report.visibilityMeters.value_or(500) < 1500;
  if (foggy && std::none_of(drafts.begin(), drafts.end(), hasFog)) {
    layers.push_back(
        layerOf(air, Genus::Fog, report.weather.fogCover, air.surfaceMeters, air.surfaceMeters + 100));
    thickenFog(layers.back(), report);
  }
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const Draft& draft = drafts[i];
    const bool fog = draft.genus == Genus::Fog,
               heaped = draft.genus == Genus::Cumulus || draft.genus == Genus::Cumulonimbus;
    const double base = air.surfaceMeters + (fog ? 0.0 : draft.height);
    double top = base + depthOf(draft, report, air, base);
    if (!fog && !heaped && i + 1 < drafts.size())
      top = std::min(top, std::max(base + 100, air.surfaceMeters + drafts[i + 1].height));
    const double storms =
        draft.genus == Genus::Cumulonimbus ? std::min(draft.cover, kMostStormCover) : draft.cover;
    layers.push_back(layerOf(air, draft.genus, storms, base, top));
    if (fog) thickenFog(layers.back(), report);
    if (draft.cover > storms + 0.05)
      layers.push_back(
          layerOf(air, Genus::Stratocumulus, (draft.cover - storms) / (1 - storms), base, base + 800));
  }
  return layers;
}

}  // namespace cloudgen::input
