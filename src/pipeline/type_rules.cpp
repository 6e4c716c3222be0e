// SPDX-License-Identifier: Apache-2.0
#include "pipeline/type_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace cloudgen::pipeline {
namespace {

using base::Genus;
using enum Comparison;

Demand that(Trait trait, Comparison comparison, float number) {
  return {{{{trait, comparison, number}}}, {}, false};
}

Demand that(Trait trait, Comparison comparison, Border border) {
  return {{{{trait, comparison, 0, border}}}, {}, false};
}

Demand eitherOf(const Condition& one, const Condition& other) { return {{{one}, {other}}, {}, false}; }

/// Small or broken: what covers little of its cell is heaped; so is what covers half of it in unstable air
/// (a K-index over 20 makes tall convection likely, as in himan's cloud_code), or stands alone and leaves
/// more than an octa of the sky open.
const Demand kHeaped{{{{Trait::CoverAround, Under, 0.3f}},
                      {{Trait::KIndexAround, Over, 20}, {Trait::CoverAround, Under, 0.5f}},
                      {{Trait::PatchArea, Under, 400}, {Trait::CoverAround, Under, 0.875f}}},
                     "heaped",
                     false};
const Demand kNotHeaped{kHeaped.alternatives, kHeaped.name, true};

const Demand kHigh = that(Trait::Base, AtLeast, Border::HighEtage);
const Demand kMiddle = that(Trait::Base, AtLeast, Border::MiddleEtage);
const Demand kNotHigh = that(Trait::Base, Under, Border::HighEtage);
const Demand kLow = that(Trait::Base, Under, Border::MiddleEtage);
const Demand kIce = that(Trait::IceShare, Over, 0.5f);
const Demand kUnstable = that(Trait::KIndexAround, Over, 20);

/// In the order of CDFS II (thesis ch. IV): cirrus, cumulonimbus and fog by signature, then by extent and
/// height. Optical depths of 3.6 and 23 are the borders of ISCCP's classes (Rossow & Schiffer 1999).
const std::vector<Rule> kRules{
    {"cirrus.grains",
     Genus::Cirrocumulus,
     {kHigh, kIce, that(Trait::Depth, Under, 700), that(Trait::CoverAround, Over, 0.4f),
      that(Trait::OpticalDepthAround, Under, 2)}},
    {"cirrus.veil",
     Genus::Cirrostratus,
     {kHigh, kIce, that(Trait::CoverAround, Over, 0.5f), that(Trait::OpticalDepthAround, Over, 0.3f),
      that(Trait::OpticalDepthAround, AtMost, 3.6f)}},
    {"cirrus.signature",
     Genus::Cirrus,
     {kHigh, kIce, eitherOf({Trait::OpticalDepthAround, AtMost, 3.6f}, {Trait::CoverAround, AtMost, 0.5f})}},
    {"cirrus.thick", Genus::Cirrostratus, {kHigh, kIce}},
    {"cumulonimbus.signature",
     Genus::Cumulonimbus,
     {that(Trait::BaseAboveGround, Under, 3000), that(Trait::Depth, Over, 5000),
      that(Trait::TopTemperature, Under, 248.15f), that(Trait::OpticalDepth, Over, 23), kUnstable}},
    {"fog.signature",
     Genus::Fog,
     {that(Trait::BaseAboveGround, Under, 60), that(Trait::TopAboveGround, Under, 400)}},
    {"low.deep_cumuliform", Genus::Cumulonimbus, {kLow, kHeaped, that(Trait::Depth, Over, 5000)}},
    {"low.cumuliform", Genus::Cumulus, {kLow, kHeaped}},
    {"rain.deep", Genus::Nimbostratus, {kLow, kNotHeaped, that(Trait::Depth, Over, 2500)}},
    {"low.uniform",
     Genus::Stratus,
     {kLow, kNotHeaped, that(Trait::BaseAboveGround, Under, 600), that(Trait::Depth, Under, 700)}},
    {"low.rolls", Genus::Stratocumulus, {kLow, kNotHeaped}},
    {"middle.tower",
     Genus::Cumulonimbus,
     {kMiddle, kNotHigh, that(Trait::Depth, Over, 5000), kUnstable, kHeaped}},
    {"middle.rain",
     Genus::Nimbostratus,
     {kMiddle, kNotHigh, that(Trait::Base, Under, 3500), that(Trait::Depth, Over, 3000),
      that(Trait::OpticalDepthAround, Over, 23)}},
    {"middle.elements",
     Genus::Altocumulus,
     {kMiddle, kNotHigh, eitherOf({Trait::Depth, Under, 1000}, {Trait::CoverAround, Under, 0.5f})}},
    {"middle.veil", Genus::Altostratus, {kMiddle, kNotHigh}},
    {"high.default", Genus::Cirrus, {kHigh}},
};

constexpr std::array<TraitText, kTraitCount> kTraitTexts{{
    {"base", "m"},
    {"base above ground", "m"},
    {"top above ground", "m"},
    {"depth", "m"},
    {"optical depth", "", 1, 0, 2},
    {"ice share of optical depth", "%", 100, 0, 1},
    {"top temperature", "C", 1, -273.15f, 1},
    {"area of the patch", "km2"},
    {"cover here and around", "%", 100, 0, 1},
    {"optical depth here and around", "", 1, 0, 2},
    {"K-index here and around", "C", 1, 0, 1},
}};

std::string textOf(const std::vector<Condition>& together) {
  std::vector<std::string> texts;
  for (const Condition& condition : together) texts.push_back(textOf(condition));
  return fmt::format("{}", fmt::join(texts, " and "));
}

}  // namespace

std::span<const Rule> derivingRules() { return kRules; }

float limitOf(const Condition& condition, const Traits& traits) {
  switch (condition.border) {
    case Border::MiddleEtage:
      return traits.middleEtageMeters;
    case Border::HighEtage:
      return traits.highEtageMeters;
    default:
      return condition.number;
  }
}

bool holds(const Condition& condition, const Traits& traits) {
  const float value = traits[condition.trait], limit = limitOf(condition, traits);
  switch (condition.comparison) {
    case Under:
      return value < limit;
    case AtMost:
      return value <= limit;
    case Over:
      return value > limit;
    default:
      return value >= limit;
  }
}

bool holds(const Demand& demand, const Traits& traits) {
  const bool met = std::any_of(demand.alternatives.begin(), demand.alternatives.end(), [&](auto& together) {
    return std::all_of(together.begin(), together.end(),
                       [&](const Condition& condition) { return holds(condition, traits); });
  });
  return met != demand.denied;
}

bool holds(const Rule& rule, const Traits& traits) {
  return std::all_of(rule.demands.begin(), rule.demands.end(),
                     [&](const Demand& demand) { return holds(demand, traits); });
}

const Rule& decidingRule(const Traits& traits) {
  const auto found =
      std::find_if(kRules.begin(), kRules.end(), [&](const Rule& rule) { return holds(rule, traits); });
  return found == kRules.end() ? kRules.back() : *found;
}

const TraitText& textOf(Trait trait) { return kTraitTexts[static_cast<std::size_t>(trait)]; }

std::string_view textOf(Comparison comparison) {
  constexpr std::array<std::string_view, 4> kTexts{"under", "at most", "over", "at least"};
  return kTexts[static_cast<std::size_t>(comparison)];
}

std::string textOf(Trait trait, float value) {
  if (!std::isfinite(value)) return "unknown";
  const TraitText& text = textOf(trait);
  std::string shown;
  base::appendFixed(shown, text.shown(value), text.decimals);
  return text.unit.empty() ? shown : fmt::format("{} {}", shown, text.unit);
}

std::string textOf(const Condition& condition) {
  const std::string limit = condition.border == Border::MiddleEtage ? "the middle etage's border"
                            : condition.border == Border::HighEtage
                                ? "the high etage's border"
                                : textOf(condition.trait, condition.number);
  return fmt::format("{} {} {}", textOf(condition.trait).name, textOf(condition.comparison), limit);
}

std::string textOf(const Demand& demand) {
  std::vector<std::string> texts;
  for (const auto& together : demand.alternatives) texts.push_back(textOf(together));
  const std::string any = fmt::format("{}", fmt::join(texts, " or "));
  if (demand.name.empty()) return any;
  return demand.denied ? fmt::format("not {}", demand.name) : fmt::format("{} ({})", demand.name, any);
}

}  // namespace cloudgen::pipeline
