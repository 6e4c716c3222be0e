// SPDX-License-Identifier: Apache-2.0
#include "input/grib/selection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"

namespace cloudgen::input::grib {
namespace {

using field::Quantity;

bool isCloudWater(const std::optional<Quantity>& quantity) {
  return quantity == Quantity::CloudCondensate || quantity == Quantity::CloudLiquid ||
         quantity == Quantity::CloudIce;
}

/// The first few names of what a file holds, for messages.
std::string contentsOf(const std::vector<FieldHeader>& headers) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> names;
  for (const FieldHeader& header : headers)
    if (std::find(names.begin(), names.end(), header.shortName) == names.end())
      names.push_back(header.shortName);
  const std::size_t others = names.size() > kMost ? names.size() - kMost : 0;
  names.resize(names.size() - others);
  return fmt::format("{}{}", fmt::join(names, ", "), others ? fmt::format(" and {} others", others) : "");
}

[[noreturn]] void noCloudWater(const std::vector<FieldHeader>& headers, const std::string& where) {
  for (const FieldHeader& header : headers)
    if (isCloudWater(header.quantity))
      throw base::InputError(where,
                             fmt::format("has {} on levels of type {} only, which are not read yet",
                                         header.shortName, header.levelType),
                             "give cloud water on pressure levels (isobaricInhPa)");
  throw base::InputError(
      where, fmt::format("has no cloud water on pressure levels; it holds {}", contentsOf(headers)),
      "give a file with cloud water or ice (clwmr, icmr, clwc, ciwc) on pressure levels");
}

/// The first of several times or members, and a warning that names the others.
template <class Value, class Name>
Value firstOf(const std::set<Value>& values, std::string_view what, const Name& name,
              std::vector<std::string>& warnings) {
  constexpr std::size_t kMost = 8;
  if (values.size() > 1) {
    std::vector<std::string> others;
    for (const Value& value : values)
      if (value != *values.begin() && others.size() < kMost) others.push_back(name(value));
    const std::string rest =
        values.size() - 1 > kMost ? fmt::format(" and {} more", values.size() - 1 - kMost) : "";
    warnings.push_back(fmt::format("{} {}s in the input: {} is taken, left out: {}{}", values.size(), what,
                                   name(*values.begin()), fmt::join(others, ", "), rest));
  }
  return *values.begin();
}

std::string hectopascals(double pressurePa) { return fmt::format("{:g}", pressurePa / 100); }

}  // namespace

bool Selection::has(Quantity quantity) const {
  return std::any_of(levels.begin(), levels.end(),
                     [&](const auto& level) { return level.second.contains(quantity); });
}

const FieldHeader& Selection::cloudWater() const {
  for (const auto& [pressure, fields] : levels)
    for (const auto& [quantity, header] : fields)
      if (isCloudWater(quantity)) return header;
  throw base::InputError("GRIB", "has no cloud water", "give a file that has");
}

Selection select(const std::vector<FieldHeader>& headers, const std::string& where) {
  Selection selection;
  std::set<base::UtcTime> times;
  const FieldHeader* first = nullptr;
  for (const FieldHeader& header : headers)
    if (header.role == Role::Level && isCloudWater(header.quantity)) times.insert(header.valid);
  if (times.empty()) noCloudWater(headers, where);
  selection.valid = firstOf(
      times, "valid time", [](base::UtcTime time) { return base::isoText(time); }, selection.warnings);

  std::set<long> members;
  for (const FieldHeader& header : headers)
    if (header.role == Role::Level && isCloudWater(header.quantity) && header.valid == selection.valid)
      members.insert(header.member);
  const long member = firstOf(
      members, "ensemble member", [](long value) { return std::to_string(value); }, selection.warnings);
  const auto matches = [&](const FieldHeader& header) {
    return header.valid == selection.valid && header.member == member;
  };
  for (const FieldHeader& header : headers)
    if (!first && header.role == Role::Level && isCloudWater(header.quantity) && matches(header))
      first = &header;
  selection.run = first->run;

  const bool iceApart = std::any_of(headers.begin(), headers.end(), [&](const FieldHeader& header) {
    return header.role == Role::Level && header.quantity == Quantity::CloudIce && matches(header);
  });
  std::size_t repeated = 0, otherGrids = 0;
  for (const FieldHeader& header : headers) {
    if (header.role == Role::Other || (!matches(header) && header.role != Role::SurfaceHeight)) continue;
    if (header.gridKey != first->gridKey) {
      ++otherGrids;
      continue;
    }
    if (header.role == Role::SurfacePressure) selection.surfacePressure = header;
    if (header.role == Role::SurfaceHeight) selection.surfaceHeight = header;
    if (header.role != Role::Level) continue;
    // Where ice has a field of its own, "cloud mixing ratio" means the liquid.
    const bool liquid = iceApart && header.quantity == Quantity::CloudCondensate;
    if (!selection.levels[header.pressurePa]
             .emplace(liquid ? Quantity::CloudLiquid : *header.quantity, header)
             .second)
      ++repeated;
  }
  if (repeated)
    selection.warnings.push_back(
        fmt::format("{} fields are there twice: the first of each is taken", repeated));
  if (otherGrids)
    selection.warnings.push_back(fmt::format("{} fields on another grid are left out", otherGrids));
  if (selection.has(Quantity::CloudCondensate))
    selection.warnings.push_back(
        fmt::format("{} is liquid and ice in one field: it is split by temperature", first->shortName));
  return selection;
}

std::vector<std::string> fieldLines(const Selection& selection) {
  struct Use {
    std::string shortName;
    int levels = 0;
    double lowest = 0, highest = 0;
  };
  std::map<Quantity, Use> uses;
  for (const auto& [pressure, fields] : selection.levels)
    for (const auto& [quantity, header] : fields) {
      Use& use = uses[quantity];
      if (use.levels++ == 0) use = {header.shortName, 1, pressure, pressure};
      use.highest = pressure;
    }
  std::vector<std::string> lines;
  for (const auto& [quantity, use] : uses)
    lines.push_back(fmt::format("{}: {} on {} level{}, {} to {} hPa", field::quantityName(quantity),
                                use.shortName, use.levels, use.levels == 1 ? "" : "s",
                                hectopascals(use.lowest), hectopascals(use.highest)));
  if (selection.surfaceHeight) lines.push_back("surface height: " + selection.surfaceHeight->shortName);
  if (selection.surfacePressure) lines.push_back("surface pressure: " + selection.surfacePressure->shortName);
  return lines;
}

std::vector<std::string> missingLines(const Selection& selection) {
  std::vector<std::string> lines;
  if (!selection.has(Quantity::Temperature))
    lines.emplace_back("temperature: missing, and nothing can replace it");
  if (!selection.has(Quantity::GeopotentialHeight))
    lines.emplace_back("geopotential height: missing, and nothing can replace it");
  const bool humidity =
      selection.has(Quantity::RelativeHumidity) || selection.has(Quantity::SpecificHumidity);
  if (!selection.has(Quantity::CloudFraction))
    lines.emplace_back(
        humidity ? "cloud fraction: derived from relative humidity and condensate (Xu & Randall 1996)"
                 : "cloud fraction: missing, and no humidity is there to derive it from");
  if (selection.has(Quantity::CloudCondensate))
    lines.emplace_back(
        "liquid and ice apart: condensate is split by temperature (IFS diagnostic mixed phase)");
  if (!selection.has(Quantity::WindEast) || !selection.has(Quantity::WindNorth))
    lines.emplace_back("wind: taken as calm, so clouds neither lean nor line up");
  if (!selection.surfaceHeight && !selection.surfacePressure)
    lines.emplace_back("orography: the lowest level is taken as the ground");
  return lines;
}

}  // namespace cloudgen::input::grib
