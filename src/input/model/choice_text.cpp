// SPDX-License-Identifier: Apache-2.0
// A choice in words, for reports.
#include <fmt/format.h>

#include "input/model/choice.hpp"

namespace cloudgen::input::model {
namespace {

using field::Quantity;

std::string_view kindName(VerticalKind kind) {
  switch (kind) {
    case VerticalKind::Pressure:
      return "pressure";
    case VerticalKind::Hybrid:
      return "hybrid";
    case VerticalKind::Sigma:
      return "sigma";
    case VerticalKind::HeightAboveSea:
      return "height above sea";
    case VerticalKind::HeightAboveGround:
      return "height above ground";
    case VerticalKind::ModelLevel:
      break;
  }
  return "model";
}

std::string_view unitOf(VerticalKind kind) {
  if (kind == VerticalKind::Pressure) return "hPa";
  return kind == VerticalKind::HeightAboveSea || kind == VerticalKind::HeightAboveGround ? "m" : "";
}

double shownValue(const Vertical& vertical) {
  return vertical.kind == VerticalKind::Pressure ? vertical.value / 100 : vertical.value;
}

std::string_view partName(CloudPart part) {
  constexpr std::string_view kNames[] = {"total", "low", "middle", "high", "convective"};
  return kNames[static_cast<std::size_t>(part)];
}

bool hasWater(const ChosenLevel& level) {
  return level.fields.contains(Quantity::CloudCondensate) || level.fields.contains(Quantity::CloudLiquid) ||
         level.fields.contains(Quantity::CloudIce);
}

bool hasHumidity(const ChosenLevel& level) {
  return level.fields.contains(Quantity::RelativeHumidity) ||
         level.fields.contains(Quantity::SpecificHumidity);
}

}  // namespace

std::string singleName(const Single& single) {
  switch (single.kind) {
    case SingleKind::SurfacePressure:
      return "surface pressure";
    case SingleKind::LogSurfacePressure:
      return "logarithm of surface pressure";
    case SingleKind::SeaLevelPressure:
      return "sea level pressure";
    case SingleKind::SurfaceHeight:
      return "surface height";
    case SingleKind::CloudCover:
      return fmt::format("{} cloud cover", partName(single.part));
    case SingleKind::CloudBaseHeight:
      return fmt::format("{} cloud base height", partName(single.part));
    case SingleKind::CloudTopHeight:
      return fmt::format("{} cloud top height", partName(single.part));
    case SingleKind::CloudBasePressure:
      return fmt::format("{} cloud base pressure", partName(single.part));
    case SingleKind::CloudTopPressure:
      break;
  }
  return fmt::format("{} cloud top pressure", partName(single.part));
}

field::LevelList levelList(const Choice& choice) {
  field::LevelList list;
  for (const ChosenLevel& level : choice.levels) {
    if (choice.basis == Basis::Water && !hasWater(level)) continue;
    if (choice.basis == Basis::Humidity && !hasHumidity(level)) continue;
    list.kind = kindName(level.vertical.kind);
    list.unit = unitOf(level.vertical.kind);
    list.values.push_back(shownValue(level.vertical));
  }
  return list;
}

std::vector<std::string> fieldLines(const Choice& choice) {
  struct Use {
    std::string name;
    std::vector<Vertical> levels;
  };
  std::map<Quantity, Use> uses;
  for (const ChosenLevel& level : choice.levels)
    for (const auto& [quantity, field] : level.fields) {
      uses[quantity].name = field.name;
      uses[quantity].levels.push_back(level.vertical);
    }
  std::vector<std::string> lines;
  for (const auto& [quantity, use] : uses) {
    const Vertical &lowest = use.levels.front(), &highest = use.levels.back();
    lines.push_back(fmt::format("{}: {} on {} {} level{}, {:g} to {:g}{}{}", field::quantityName(quantity),
                                use.name, use.levels.size(), kindName(lowest.kind),
                                use.levels.size() == 1 ? "" : "s", shownValue(lowest), shownValue(highest),
                                unitOf(lowest.kind).empty() ? "" : " ", unitOf(lowest.kind)));
  }
  for (const auto& [single, field] : choice.singles)
    lines.push_back(fmt::format("{}: {}", singleName(single), field.name));
  return lines;
}

std::vector<std::string> missingLines(const Choice& choice) {
  std::vector<std::string> lines;
  if (choice.basis == Basis::Cover) {
    lines.emplace_back("water and levels: clouds are layers made from the cover alone");
    return lines;
  }
  if (!choice.has(Quantity::Temperature))
    lines.emplace_back(
        "temperature: from the thickness between geopotential heights, else the standard atmosphere");
  if (!choice.has(Quantity::GeopotentialHeight) && !choice.has(Quantity::Height) &&
      !choice.has(Quantity::HeightAboveGround))
    lines.emplace_back("height: from pressure and temperature by the hypsometric equation");
  const bool humid = choice.has(Quantity::RelativeHumidity) || choice.has(Quantity::SpecificHumidity);
  if (choice.basis == Basis::Humidity)
    lines.emplace_back("cloud water: derived from RH (fraction by Sundqvist 1989, water estimated)");
  else if (!choice.has(Quantity::CloudFraction))
    lines.emplace_back(
        humid ? "cloud fraction: derived from relative humidity and condensate (Xu & Randall 1996)"
              : "cloud fraction: derived from condensate in saturated air (Xu & Randall 1996)");
  if (choice.has(Quantity::CloudCondensate))
    lines.emplace_back(
        "liquid and ice apart: condensate is split by temperature (IFS diagnostic mixed phase)");
  if (!choice.has(Quantity::WindEast) || !choice.has(Quantity::WindNorth))
    lines.emplace_back("wind: taken as calm, so clouds neither lean nor line up");
  if (!choice.has(SingleKind::SurfaceHeight) && !choice.has(SingleKind::SurfacePressure) &&
      !choice.has(SingleKind::LogSurfacePressure))
    lines.emplace_back(!choice.levels.empty() && choice.levels.front().vertical.kind == VerticalKind::Pressure
                           ? "orography: the ground is taken to lie at sea level"
                           : "orography: the lowest level is taken as the ground");
  return lines;
}

}  // namespace cloudgen::input::model
