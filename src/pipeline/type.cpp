// SPDX-License-Identifier: Apache-2.0
#include "pipeline/type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

namespace cloudgen::pipeline {
namespace {

using field::Layer;

std::string meaningOf(const Rule& rule) {
  std::vector<std::string> texts;
  for (const Demand& demand : rule.demands) texts.push_back(textOf(demand));
  return fmt::format("{}: {}", fmt::join(texts, ", "), base::name(rule.genus));
}

std::vector<TypeRule> allRules() {
  std::vector<TypeRule> rules{
      {"stated", "the source states the genus"},
      {"typing", "the cloud typing states the genus, the model the amount"},
      {"typing.alone", "the cloud typing states the genus and, as the model has no cloud there, the amount"},
      {"typing.spread",
       "the model has more of this cloud than the typed cells hold: it spreads to clear cells"}};
  for (const Rule& rule : derivingRules()) rules.push_back({rule.id, meaningOf(rule)});
  return rules;
}

}  // namespace

std::span<const TypeRule> typeRules() {
  static const std::vector<TypeRule> kRules = allRules();
  return kRules;
}

Traits traitsOf(const Layer& layer, const Surroundings& surroundings) {
  Traits traits;
  // WMO etages by latitude: lower borders of the middle and high etage, from the polar to the tropical
  // values.
  const double warm = std::pow(std::cos(surroundings.latitudeDegrees * std::numbers::pi / 180.0), 2.0);
  traits.middleEtageMeters = 2000;
  traits.highEtageMeters = static_cast<float>(3500.0 + 3000.0 * warm);
  traits[Trait::Base] = layer.baseMeters;
  traits[Trait::BaseAboveGround] = layer.baseMeters - layer.surfaceMeters;
  traits[Trait::TopAboveGround] = layer.topMeters - layer.surfaceMeters;
  traits[Trait::Depth] = layer.depthMeters();
  traits[Trait::CoverAround] = surroundings.coverAround;
  traits[Trait::OpticalDepth] = layer.opticalDepth();
  traits[Trait::OpticalDepthAround] = surroundings.opticalDepthAround;
  traits[Trait::IceShare] = layer.iceOpticalDepth / layer.opticalDepth();
  traits[Trait::TopTemperature] = layer.topTemperatureK;
  traits[Trait::KIndexAround] = surroundings.kIndexAroundC;
  traits[Trait::PatchArea] = surroundings.patchSquareKilometers;
  return traits;
}

std::vector<Surroundings> typeLayers(const field::Grid& grid, std::vector<Layer>& layers) {
  std::vector<Surroundings> surroundings = surroundingsOf(grid, layers);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!layers[i].rule.empty()) continue;
    const Rule& rule = decidingRule(traitsOf(layers[i], surroundings[i]));
    layers[i].genus = rule.genus;
    layers[i].rule = rule.id;
  }
  return surroundings;
}

}  // namespace cloudgen::pipeline
