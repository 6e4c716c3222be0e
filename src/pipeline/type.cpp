// SPDX-License-Identifier: Apache-2.0
#include "pipeline/type.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace cloudgen::pipeline {
namespace {

using base::Genus;
using field::Layer;

/// WMO etages by latitude: lower borders of the middle and high etage in metres, from the polar to the
/// tropical values.
struct Etages {
  float middleMeters, highMeters;
};

Etages etagesAt(double latitudeDegrees) {
  const double warm = std::pow(std::cos(latitudeDegrees * std::numbers::pi / 180.0), 2.0);
  return {2000.0f, static_cast<float>(3500.0 + 3000.0 * warm)};
}

/// What the rules look at.
struct Traits {
  Etages etages;
  float baseAboveGround, topAboveGround, depth, opticalDepth, fraction, iceShare;
  double patchSquareKilometers;
  bool unstable;  ///< K-index over 20: tall convection likely (himan cloud_code)
  bool cumuliform;
};

struct Verdict {
  Genus genus;
  std::string_view rule;
};

constexpr std::array<TypeRule, 20> kRules{{
    {"stated", "the source states the genus"},
    {"typing", "the cloud typing states the genus, the model the amount"},
    {"typing.alone", "the cloud typing states the genus and, as the model has no cloud there, the amount"},
    {"typing.spread",
     "the model has more of this cloud than the typed cells hold: it spreads to clear cells"},
    {"cirrus.veil",
     "ice above the high etage's border, cover over 60 %, optical depth 0.3 to 3.6: cirrostratus"},
    {"cirrus.grains",
     "thin layer above the high etage's border, under 700 m deep, cover over 40 %: cirrocumulus"},
    {"cirrus.signature", "ice above the high etage's border, optical depth under 3.6 or broken: cirrus"},
    {"cirrus.thick", "base above the high etage's border, optical depth over 3.6: cirrostratus"},
    {"cumulonimbus.signature",
     "low base, over 5 km deep, top colder than -25 C, optical depth over 23, K-index over 20: cumulonimbus"},
    {"fog.signature", "base within 60 m of the ground, top below 400 m: fog"},
    {"rain.deep", "stratiform, base below 3 km, over 2.5 km deep, optical depth over 20: nimbostratus"},
    {"low.cumuliform", "low base, small or broken patch: cumulus"},
    {"low.deep_cumuliform", "low base, broken, over 5 km deep: cumulonimbus"},
    {"low.uniform", "low stratiform, base below 600 m, under 700 m deep: stratus"},
    {"low.rolls", "low stratiform: stratocumulus"},
    {"middle.elements", "middle, broken or under 1 km deep: altocumulus"},
    {"middle.veil", "middle, continuous: altostratus"},
    {"middle.rain", "middle base below 3.5 km, over 3 km deep, optical depth over 23: nimbostratus"},
    {"middle.tower", "middle base, over 5 km deep, unstable and broken: cumulonimbus"},
    {"high.default", "high, by height alone: cirrus"},
}};

Verdict highGenus(const Traits& traits) {
  if (traits.depth < 700 && traits.fraction > 0.4f && traits.opticalDepth < 2)
    return {Genus::Cirrocumulus, "cirrus.grains"};
  if (traits.fraction > 0.6f && traits.opticalDepth > 0.3f && traits.opticalDepth <= 3.6f)
    return {Genus::Cirrostratus, "cirrus.veil"};
  if (traits.opticalDepth <= 3.6f || traits.fraction <= 0.6f) return {Genus::Cirrus, "cirrus.signature"};
  return {Genus::Cirrostratus, "cirrus.thick"};
}

Verdict verdict(const Layer& layer, const Traits& traits) {
  if (layer.baseMeters >= traits.etages.highMeters && traits.iceShare > 0.5f) return highGenus(traits);
  if (traits.baseAboveGround < 3000 && traits.depth > 5000 && layer.topTemperatureK < 248.15f &&
      traits.opticalDepth > 23 && traits.unstable)
    return {Genus::Cumulonimbus, "cumulonimbus.signature"};
  if (traits.baseAboveGround < 60 && traits.topAboveGround < 400) return {Genus::Fog, "fog.signature"};
  if (layer.baseMeters < traits.etages.middleMeters) {
    if (!traits.cumuliform && traits.depth > 2500 && traits.opticalDepth > 20)
      return {Genus::Nimbostratus, "rain.deep"};
    if (traits.cumuliform)
      return traits.depth > 5000 ? Verdict{Genus::Cumulonimbus, "low.deep_cumuliform"}
                                 : Verdict{Genus::Cumulus, "low.cumuliform"};
    if (traits.baseAboveGround < 600 && traits.depth < 700) return {Genus::Stratus, "low.uniform"};
    return traits.depth > 2500 ? Verdict{Genus::Nimbostratus, "rain.deep"}
                               : Verdict{Genus::Stratocumulus, "low.rolls"};
  }
  if (layer.baseMeters < traits.etages.highMeters) {
    if (traits.depth > 5000 && traits.unstable && traits.cumuliform)
      return {Genus::Cumulonimbus, "middle.tower"};
    if (layer.baseMeters < 3500 && traits.depth > 3000 && traits.opticalDepth > 23)
      return {Genus::Nimbostratus, "middle.rain"};
    if (traits.depth < 1000 || traits.fraction < 0.5f) return {Genus::Altocumulus, "middle.elements"};
    return {Genus::Altostratus, "middle.veil"};
  }
  return {Genus::Cirrus, "high.default"};
}

}  // namespace

std::span<const TypeRule> typeRules() { return kRules; }

void typeLayers(const field::Grid& grid, std::vector<Layer>& layers) {
  std::vector<double> patchArea;
  for (const Layer& layer : layers) {
    if (patchArea.size() <= layer.patch) patchArea.resize(layer.patch + 1, 0.0);
    patchArea[layer.patch] += 1e-6 * layer.fraction * field::cellAreaSquareMeters(grid, layer.cell);
  }
  for (Layer& layer : layers) {
    if (!layer.rule.empty()) continue;
    const field::GeoPoint center = field::centerOf(grid, layer.cell);
    Traits traits;
    traits.etages = etagesAt(center.latitudeDegrees);
    traits.baseAboveGround = layer.baseMeters - layer.surfaceMeters;
    traits.topAboveGround = layer.topMeters - layer.surfaceMeters;
    traits.depth = layer.depthMeters();
    traits.opticalDepth = layer.opticalDepth();
    traits.fraction = layer.fraction;
    traits.iceShare = layer.iceOpticalDepth / layer.opticalDepth();
    traits.patchSquareKilometers = patchArea[layer.patch];
    traits.unstable = layer.kIndexC > 20;
    // Small or broken: what covers little of its cell is heaped; so is what covers half of it in unstable
    // air.
    traits.cumuliform = layer.fraction < 0.3f || (traits.unstable && layer.fraction < 0.6f) ||
                        traits.patchSquareKilometers < 400;
    const Verdict decided = verdict(layer, traits);
    layer.genus = decided.genus;
    layer.rule = decided.rule;
  }
}

}  // namespace cloudgen::pipeline
