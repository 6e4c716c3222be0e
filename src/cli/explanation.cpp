// SPDX-License-Identifier: Apache-2.0
#include "cli/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/text.hpp"
#include "pipeline/type.hpp"

namespace cloudgen::cli {
namespace {

using field::Layer;
using nlohmann::ordered_json;
using pipeline::Condition;
using pipeline::Demand;
using pipeline::LayerRecord;
using pipeline::Rule;
using pipeline::Traits;
using scene::CloudRecord;

constexpr double kFeetPerMeter = 1 / 0.3048;

/// The rules that were tried, as they see the layer; `decided` is the last of them.
struct Decision {
  Traits traits;
  std::vector<const Rule*> failed;
  const Rule* decided = nullptr;
};

/// Nothing where somebody else stated the genus.
std::optional<Decision> decisionOf(const LayerRecord& record) {
  const auto rules = pipeline::derivingRules();
  const auto isDeciding = [&](const Rule& rule) { return rule.id == record.layer.rule; };
  if (std::none_of(rules.begin(), rules.end(), isDeciding)) return std::nullopt;
  Decision decision{pipeline::traitsOf(record.layer, record.surroundings), {}, nullptr};
  decision.decided = &pipeline::decidingRule(decision.traits);
  for (const Rule& rule : rules) {
    if (&rule == decision.decided) break;
    decision.failed.push_back(&rule);
  }
  return decision;
}

const Demand& firstUnmet(const Rule& rule, const Traits& traits) {
  return *std::find_if(rule.demands.begin(), rule.demands.end(),
                       [&](const Demand& demand) { return !pipeline::holds(demand, traits); });
}

std::string_view meaningOf(std::string_view id) {
  for (const pipeline::TypeRule& rule : pipeline::typeRules())
    if (rule.id == id) return rule.meaning;
  return {};
}

// --- for machines

/// The double that people would write; null for what is unknown.
ordered_json number(float value) {
  double read = 0;
  return base::parseNumber(base::shortest(value), read) ? ordered_json(read) : ordered_json(nullptr);
}

ordered_json conditionJson(const Condition& condition, const Traits& traits) {
  const pipeline::TraitText& text = pipeline::textOf(condition.trait);
  const char* border = condition.border == pipeline::Border::MiddleEtage ? "middle etage"
                       : condition.border == pipeline::Border::HighEtage ? "high etage"
                                                                         : "number";
  return {{"trait", text.name},
          {"unit", text.unit},
          {"value", number(text.shown(traits[condition.trait]))},
          {"comparison", pipeline::textOf(condition.comparison)},
          {"limit", number(text.shown(pipeline::limitOf(condition, traits)))},
          {"limit_is", border},
          {"holds", pipeline::holds(condition, traits)}};
}

ordered_json demandJson(const Demand& demand, const Traits& traits) {
  ordered_json alternatives = ordered_json::array();
  for (const auto& together : demand.alternatives) {
    alternatives.push_back(ordered_json::array());
    for (const Condition& condition : together)
      alternatives.back().push_back(conditionJson(condition, traits));
  }
  return {{"name", demand.name},
          {"denied", demand.denied},
          {"alternatives", std::move(alternatives)},
          {"met", pipeline::holds(demand, traits)}};
}

ordered_json cloudJson(const CloudRecord& cloud) {
  return {{"id", std::to_string(cloud.id)},    {"genus", base::abbreviation(cloud.genus)},
          {"name", base::name(cloud.genus)},   {"longitude", cloud.longitudeDegrees},
          {"latitude", cloud.latitudeDegrees}, {"base_m", number(cloud.baseMeters)},
          {"top_m", number(cloud.topMeters)},  {"optical_depth", number(cloud.opticalDepth)}};
}

ordered_json layerJson(const LayerRecord& record) {
  const Layer& layer = record.layer;
  const pipeline::Surroundings& around = record.surroundings;
  return {{"cell", layer.cell},
          {"layer", layer.ordinal},
          {"longitude", around.longitudeDegrees},
          {"latitude", around.latitudeDegrees},
          {"cell_km2", number(around.cellSquareKilometers)},
          {"surface_m", number(layer.surfaceMeters)},
          {"base_m", number(layer.baseMeters)},
          {"top_m", number(layer.topMeters)},
          {"cover", number(layer.fraction)},
          {"liquid_optical_depth", number(layer.liquidOpticalDepth)},
          {"ice_optical_depth", number(layer.iceOpticalDepth)},
          {"base_temperature_k", number(layer.baseTemperatureK)},
          {"top_temperature_k", number(layer.topTemperatureK)},
          {"top_pressure_pa", layer.topPressurePa > 0 ? number(layer.topPressurePa) : ordered_json(nullptr)},
          {"k_index_c", number(layer.kIndexC)},
          {"wind_m_s", {number(layer.windEast), number(layer.windNorth)}},
          {"shear_m_s", {number(layer.shearEast), number(layer.shearNorth)}},
          {"patch", layer.patch},
          {"patch_km2", number(around.patchSquareKilometers)},
          {"cover_around", number(around.coverAround)},
          {"optical_depth_around", number(around.opticalDepthAround)},
          {"k_index_around_c", number(around.kIndexAroundC)}};
}

// --- for people

std::string fixed(double value, int decimals) {
  std::string text;
  base::appendFixed(text, value, decimals);
  return text;
}

std::string heightText(double meters) {
  return fmt::format("{:.0f} m ({:.0f} ft)", meters, std::round(meters * kFeetPerMeter / 10) * 10);
}

std::string placeText(double longitude, double latitude) {
  return fmt::format("{:.3f} {}, {:.3f} {}", std::abs(latitude), latitude < 0 ? "S" : "N",
                     std::abs(longitude), longitude < 0 ? "W" : "E");
}

std::string celsiusText(float kelvin) {
  return std::isfinite(kelvin) ? fmt::format("{:.1f} C", kelvin - 273.15) : "unknown";
}

std::string windText(float east, float north) {
  if (std::hypot(east, north) < 0.05) return "calm or not told";
  const double from = std::atan2(-east, -north) * 180 / std::numbers::pi;
  return fmt::format("{:.1f} m/s from {:03.0f}", std::hypot(east, north),
                     std::fmod(std::round(from) + 360, 360.0));
}

std::string line(std::string_view name, const std::string& text) {
  return fmt::format("  {:<15} {}\n", name, text);
}

/// The value with the limit, "yes" or "no" behind it; where both look alike, with all digits.
std::string conditionText(const Condition& condition, const Traits& traits) {
  const float value = traits[condition.trait], limit = pipeline::limitOf(condition, traits);
  const pipeline::TraitText& text = pipeline::textOf(condition.trait);
  std::string shown = pipeline::textOf(condition.trait, value),
              shownLimit = pipeline::textOf(condition.trait, limit);
  if (shown == shownLimit && value != limit) {
    shown = base::shortest(text.shown(value));
    shownLimit = base::shortest(text.shown(limit));
  }
  const char* border = condition.border == pipeline::Border::MiddleEtage ? " (the middle etage's border)"
                       : condition.border == pipeline::Border::HighEtage ? " (the high etage's border)"
                                                                         : "";
  return fmt::format("{} {}, {} {} {}{}", text.name, shown,
                     pipeline::holds(condition, traits) ? "is" : "is not",
                     pipeline::textOf(condition.comparison), shownLimit, border);
}

/// One line where there is one condition; else a line for each, under what they are together.
std::string demandText(const Demand& demand, const Traits& traits) {
  const bool single = demand.alternatives.size() == 1 && demand.alternatives.front().size() == 1;
  if (single) return fmt::format("  {}\n", conditionText(demand.alternatives.front().front(), traits));
  const bool met = pipeline::holds(demand, traits), heldByAny = met != demand.denied;
  std::string text = demand.name.empty()
                         ? std::string(heldByAny ? "  one of these:\n" : "  none of these:\n")
                         : fmt::format("  {}{}, as {}:\n", heldByAny ? "" : "not ", demand.name,
                                       heldByAny ? "one of these is true" : "none of these is true");
  for (const auto& together : demand.alternatives) {
    text += "    - ";
    for (const Condition& condition : together)
      text += (&condition == &together.front() ? "" : ", and ") + conditionText(condition, traits);
    text += "\n";
  }
  return text;
}

/// Why a demand is not met, in a few words.
std::string unmetText(const Demand& demand, const Traits& traits) {
  if (demand.denied) return fmt::format("it is {}", demand.name);
  std::string text = demand.name.empty() ? "" : fmt::format("not {}: ", demand.name);
  for (const auto& together : demand.alternatives) {
    const auto failing = std::find_if(together.begin(), together.end(), [&](const Condition& condition) {
      return !pipeline::holds(condition, traits);
    });
    text += (&together == &demand.alternatives.front() ? "" : "; ") + conditionText(*failing, traits);
  }
  return text;
}

std::string layerText(const LayerRecord& record) {
  const Layer& layer = record.layer;
  const pipeline::Surroundings& around = record.surroundings;
  std::string text =
      fmt::format("\nfrom layer {} of model cell {}, centre {}, {:.0f} km2\n", layer.ordinal, layer.cell,
                  placeText(around.longitudeDegrees, around.latitudeDegrees), around.cellSquareKilometers);
  text += line("base", fmt::format("{}, {:.0f} m above ground", heightText(layer.baseMeters),
                                   layer.baseMeters - layer.surfaceMeters));
  text += line("top", heightText(layer.topMeters));
  text += line("cover", fmt::format("{:.1f} %; {:.1f} % here and around", 100 * layer.fraction,
                                    100 * around.coverAround));
  text += line("optical depth",
               fmt::format("{} liquid, {} ice; {} here and around", fixed(layer.liquidOpticalDepth, 2),
                           fixed(layer.iceOpticalDepth, 2), fixed(around.opticalDepthAround, 2)));
  text +=
      line("temperature", fmt::format("{} at the base, {} at the top", celsiusText(layer.baseTemperatureK),
                                      celsiusText(layer.topTemperatureK)));
  if (layer.topPressurePa > 0)
    text += line("top pressure", fmt::format("{:.0f} hPa", layer.topPressurePa / 100));
  text += line("K-index", std::isfinite(layer.kIndexC) ? fmt::format("{:.1f} C; {:.1f} C here and around",
                                                                     layer.kIndexC, around.kIndexAroundC)
                                                       : "unknown");
  text += line("wind",
               fmt::format("{}; shear from base to top {:.1f} m/s", windText(layer.windEast, layer.windNorth),
                           std::hypot(layer.shearEast, layer.shearNorth)));
  return text + line("patch",
                     fmt::format("number {}, {:.0f} km2 covered", layer.patch, around.patchSquareKilometers));
}

/// Rules in a row that failed for the same reason share a line.
std::string triedText(const Decision& decision) {
  std::string text = decision.failed.empty() ? "" : "\ntried before it", last;
  for (const Rule* rule : decision.failed) {
    const std::string reason = unmetText(firstUnmet(*rule, decision.traits), decision.traits);
    text +=
        reason == last ? fmt::format(", {}", rule->id) : fmt::format("\n  {}:\n    not {}", reason, rule->id);
    last = reason;
  }
  return text + "\n";
}

std::string decisionText(const Decision& decision, std::string_view recorded) {
  std::string text;
  if (decision.decided->id != recorded)
    text +=
        fmt::format("  (this version of cloudgen would decide by {}: the scene is older or was changed)\n",
                    decision.decided->id);
  for (const Demand& demand : decision.decided->demands) text += demandText(demand, decision.traits);
  return text + triedText(decision);
}

}  // namespace

ordered_json explanationJson(const CloudRecord& cloud, const LayerRecord& record) {
  const auto decision = decisionOf(record);
  ordered_json rule{
      {"id", record.layer.rule},
      {"meaning", meaningOf(record.layer.rule)},
      {"derived", decision.has_value()},
      {"would_decide_now", decision ? ordered_json(decision->decided->id) : ordered_json(nullptr)},
      {"demands", ordered_json::array()},
      {"tried_before", ordered_json::array()}};
  if (decision) {
    for (const Demand& demand : decision->decided->demands)
      rule["demands"].push_back(demandJson(demand, decision->traits));
    for (const Rule* failed : decision->failed)
      rule["tried_before"].push_back(
          {{"id", failed->id},
           {"unmet", demandJson(firstUnmet(*failed, decision->traits), decision->traits)}});
  }
  return {{"cloud", cloudJson(cloud)}, {"layer", layerJson(record)}, {"rule", std::move(rule)}};
}

std::string explanationText(const CloudRecord& cloud, const LayerRecord& record) {
  std::string text =
      fmt::format("cloud {}: {} ({})\n", cloud.id, base::name(cloud.genus), base::abbreviation(cloud.genus));
  text += line("place", placeText(cloud.longitudeDegrees, cloud.latitudeDegrees));
  text += line("base", heightText(cloud.baseMeters) + " above sea level");
  text += line("top", heightText(cloud.topMeters));
  text += line("optical depth", fixed(cloud.opticalDepth, 2));
  text += layerText(record);
  text += fmt::format("\nrule {}\n  {}\n", record.layer.rule, meaningOf(record.layer.rule));
  const auto decision = decisionOf(record);
  text +=
      decision ? decisionText(*decision, record.layer.rule) : "  (no rule was tried: the genus was given)\n";
  text.pop_back();
  return text;
}

}  // namespace cloudgen::cli
