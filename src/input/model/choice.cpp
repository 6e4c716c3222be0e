// SPDX-License-Identifier: Apache-2.0
#include "input/model/choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"

namespace cloudgen::input::model {
namespace {

using field::Quantity;

/// Below this many levels humidity tells less of the clouds' heights than the model's own low, middle and
/// high cover.
constexpr std::size_t kFewLevels = 8;

const Quantity* quantityOf(const Field& field) { return std::get_if<Quantity>(&field.meaning); }

const Single* singleOf(const Field& field) { return std::get_if<Single>(&field.meaning); }

bool isWater(const Field& field) {
  const Quantity* quantity = quantityOf(field);
  return quantity && (*quantity == Quantity::CloudCondensate || *quantity == Quantity::CloudLiquid ||
                      *quantity == Quantity::CloudIce);
}

bool isHumidity(const Field& field) {
  const Quantity* quantity = quantityOf(field);
  return quantity && (*quantity == Quantity::RelativeHumidity || *quantity == Quantity::SpecificHumidity);
}

bool isCover(const Field& field) {
  const Single* single = singleOf(field);
  return single && single->kind == SingleKind::CloudCover;
}

std::string where(const Contents& contents) {
  return contents.files.size() == 1 ? contents.files.front()
                                    : fmt::format("{} {} files", contents.files.size(), contents.format);
}

/// The first few names of what the files hold, for messages.
std::string namesIn(const Contents& contents) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> names;
  for (const Field& field : contents.fields)
    if (std::find(names.begin(), names.end(), field.name) == names.end()) names.push_back(field.name);
  if (names.empty()) return "no field that is known here";
  const std::size_t others = names.size() > kMost ? names.size() - kMost : 0;
  names.resize(names.size() - others);
  return fmt::format("{}{}", fmt::join(names, ", "), others ? fmt::format(" and {} others", others) : "");
}

using Test = bool (*)(const Field&);

std::size_t countOf(const Contents& contents, Test test) {
  std::set<std::pair<VerticalKind, double>> levels;
  for (const Field& field : contents.fields)
    if (test(field)) levels.insert({field.vertical.kind, field.vertical.value});
  return levels.size();
}

/// The fields that decide time, member, grid and kind of level.
std::pair<Basis, Test> basisOf(const Contents& contents) {
  if (countOf(contents, isWater) > 0) return {Basis::Water, isWater};
  const std::size_t humid = countOf(contents, isHumidity);
  std::set<CloudPart> covers;
  for (const Field& field : contents.fields)
    if (isCover(field)) covers.insert(singleOf(field)->part);
  const bool byHeight = covers.contains(CloudPart::Low) || covers.contains(CloudPart::Middle) ||
                        covers.contains(CloudPart::High);
  if (humid >= kFewLevels || (humid > 0 && !byHeight)) return {Basis::Humidity, isHumidity};
  if (!covers.empty()) return {Basis::Cover, isCover};
  throw base::InputError(where(contents),
                         fmt::format("says nothing about clouds; it holds {}", namesIn(contents)),
                         "give a file with cloud water, humidity on levels, or cloud cover");
}

/// "2024-01-01T00:00:00Z, ... and 4 more".
template <class Values, class Name>
std::string listed(const Values& values, const Name& name) {
  constexpr std::size_t kMost = 8;
  std::vector<std::string> names;
  for (const auto& value : values)
    if (names.size() < kMost) names.push_back(name(value));
  return fmt::format("{}{}", fmt::join(names, ", "),
                     values.size() > kMost ? fmt::format(" and {} more", values.size() - kMost) : "");
}

/// The fields that stand out of a larger number by one trait: keeps those with the value.
template <class Trait, class Value>
void keep(std::vector<const Field*>& fields, const Trait& trait, const Value& value) {
  std::erase_if(fields, [&](const Field* field) { return trait(*field) != value; });
}

template <class Trait>
auto valuesOf(const std::vector<const Field*>& fields, const Trait& trait) {
  std::set<std::decay_t<decltype(trait(*fields.front()))>> values;
  for (const Field* field : fields) values.insert(trait(*field));
  return values;
}

/// The value that most fields have; the smallest of equals.
template <class Trait>
auto commonest(const std::vector<const Field*>& fields, const Trait& trait) {
  std::map<std::decay_t<decltype(trait(*fields.front()))>, std::size_t> counts;
  for (const Field* field : fields) ++counts[trait(*field)];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Leaves of the leading fields those of one time, member, grid and kind of level, and says what was left
/// out.
class Narrowing {
 public:
  Narrowing(const Contents& contents, const OpenOptions& options, Test leads) : contents_(contents) {
    for (const Field& field : contents.fields)
      if (leads(field)) leading_.push_back(&field);
    chooseTime(options.time);
    chooseMember();
    chooseGrid();
    chooseLevels();
  }
  const Field& first() const { return *leading_.front(); }
  Choice& choice() { return choice_; }

 private:
  static base::UtcTime timeOf(const Field& field) { return field.valid.value_or(base::UtcTime{}); }

  void chooseTime(const std::optional<base::UtcTime>& wanted) {
    const auto times = valuesOf(leading_, timeOf);
    choice_.validTimes.assign(times.begin(), times.end());
    const auto iso = [](base::UtcTime time) { return base::isoText(time); };
    if (wanted && !times.contains(*wanted))
      throw base::InputError(where(contents_), "has no clouds for " + iso(*wanted),
                             "it has " + listed(choice_.validTimes, iso));
    choice_.valid = wanted.value_or(*times.begin());
    if (!wanted && times.size() > 1)
      choice_.warnings.push_back(
          {"several_times",
           fmt::format("{} valid times in the input: {} is taken (--time chooses another), left out: {}",
                       times.size(), iso(choice_.valid),
                       listed(std::vector(choice_.validTimes.begin() + 1, choice_.validTimes.end()), iso))});
    keep(leading_, timeOf, choice_.valid);
  }

  void chooseMember() {
    const auto memberOf = [](const Field& field) { return field.member; };
    const auto members = valuesOf(leading_, memberOf);
    if (members.size() > 1)
      choice_.warnings.push_back(
          {"several_members",
           fmt::format("{} ensemble members in the input: {} is taken", members.size(), *members.begin())});
    keep(leading_, memberOf, *members.begin());
  }

  void chooseGrid() {
    const auto gridOf = [](const Field& field) { return field.grid; };
    choice_.grid = commonest(leading_, gridOf);
    keep(leading_, gridOf, choice_.grid);
  }

  void chooseLevels() {
    const auto kindOf = [](const Field& field) { return field.vertical.kind; };
    const VerticalKind kind = commonest(leading_, kindOf);
    const std::size_t before = leading_.size();
    keep(leading_, kindOf, kind);
    if (leading_.size() < before)
      choice_.warnings.push_back(
          {"other_levels",
           fmt::format("{} fields on another kind of level are left out", before - leading_.size())});
    choice_.run = leading_.front()->run;
  }

  const Contents& contents_;
  std::vector<const Field*> leading_;
  Choice choice_;
};

/// Of a surface field any time will do where the wanted one is missing; only orography lasts.
bool fits(const Field& field, const Field& leading, const Choice& choice) {
  if (field.grid != choice.grid) return false;
  const Single* single = singleOf(field);
  if (single && single->kind == SingleKind::SurfaceHeight) return true;
  return (!field.valid || *field.valid == choice.valid) && (field.member == leading.member || !field.valid);
}

/// Sorts upwards. Numbered levels: by their pressure where hybrid coefficients tell it, else as numbered from
/// the top (WMO); makeSource() looks at the heights again.
double heightOrder(const Vertical& vertical) {
  constexpr double kMeanSurfacePa = 101325;
  switch (vertical.kind) {
    case VerticalKind::Pressure:
    case VerticalKind::Sigma:
    case VerticalKind::ModelLevel:
      return -vertical.value;
    case VerticalKind::Hybrid:
      return -(vertical.a + vertical.b * kMeanSurfacePa);
    case VerticalKind::HeightAboveSea:
    case VerticalKind::HeightAboveGround:
      break;
  }
  return vertical.value;
}

void addLevelField(const Field& field, Quantity quantity, Choice& choice, std::size_t& repeated) {
  const auto found = std::find_if(choice.levels.begin(), choice.levels.end(), [&](const ChosenLevel& level) {
    return level.vertical.value == field.vertical.value;
  });
  ChosenLevel& level =
      found == choice.levels.end() ? choice.levels.emplace_back(ChosenLevel{field.vertical, {}}) : *found;
  if (!level.fields.emplace(quantity, field).second) ++repeated;
}

/// Of a model with levels the single fields tell the ground, and where humidity makes the clouds, their base
/// and top.
bool isUsed(const Single& single, Basis basis) {
  switch (single.kind) {
    case SingleKind::CloudBaseHeight:
    case SingleKind::CloudTopHeight:
    case SingleKind::CloudBasePressure:
    case SingleKind::CloudTopPressure:
      return basis == Basis::Cover || (basis == Basis::Humidity && single.part == CloudPart::Total);
    case SingleKind::CloudCover:
      return basis == Basis::Cover;
    default:
      return true;
  }
}

/// Parts with what is of no use to the basis, and says what is not of a moment.
void keepUsed(Choice& choice) {
  std::set<std::string> averaged;
  std::erase_if(choice.singles, [&](const auto& entry) {
    const auto& [single, field] = entry;
    if (!isUsed(single, choice.basis)) {
      choice.unused.push_back(
          fmt::format("{}: {} (clouds are taken from the levels)", singleName(single), field.name));
      return true;
    }
    if (field.averaged && single.kind == SingleKind::CloudCover) averaged.insert(singleName(single));
    return false;
  });
  if (!averaged.empty())
    choice.warnings.push_back(
        {"averaged_cover",
         fmt::format("{}: an average over the hours before its valid time, not of a moment; it is "
                     "smoother than any sky was",
                     fmt::join(averaged, ", "))});
}

}  // namespace

bool Choice::has(Quantity quantity) const {
  return std::any_of(levels.begin(), levels.end(),
                     [&](const ChosenLevel& level) { return level.fields.contains(quantity); });
}

bool Choice::has(SingleKind kind, CloudPart part) const { return singles.contains({kind, part}); }

Choice choose(const Contents& contents, const OpenOptions& options) {
  const auto [basis, leads] = basisOf(contents);
  Narrowing narrowing(contents, options, leads);
  const Field leading = narrowing.first();
  Choice choice = std::move(narrowing.choice());
  choice.basis = basis;

  const auto isIce = [&](const Field& field) {
    return quantityOf(field) && *quantityOf(field) == Quantity::CloudIce && fits(field, leading, choice);
  };
  const bool iceApart = std::any_of(contents.fields.begin(), contents.fields.end(), isIce);
  std::size_t repeated = 0, elsewhere = 0;
  for (const Field& field : contents.fields) {
    if (!fits(field, leading, choice)) {
      elsewhere += field.grid != choice.grid && field.valid == choice.valid;
      continue;
    }
    if (const Single* single = singleOf(field)) {
      const auto [found, isNew] = choice.singles.emplace(*single, field);
      if (!isNew && field.valid == choice.valid) found->second = field;
      continue;
    }
    if (basis == Basis::Cover || field.vertical.kind != leading.vertical.kind) continue;
    // Where ice has a field of its own, "cloud mixing ratio" means the liquid.
    const bool liquid = iceApart && *quantityOf(field) == Quantity::CloudCondensate;
    addLevelField(field, liquid ? Quantity::CloudLiquid : *quantityOf(field), choice, repeated);
  }
  std::sort(choice.levels.begin(), choice.levels.end(), [](const ChosenLevel& a, const ChosenLevel& b) {
    return heightOrder(a.vertical) < heightOrder(b.vertical);
  });
  if (repeated)
    choice.warnings.push_back(
        {"repeated_fields", fmt::format("{} fields are there twice: the first of each is taken", repeated)});
  if (elsewhere)
    choice.warnings.push_back(
        {"other_grid", fmt::format("{} fields on another grid are left out", elsewhere)});
  if (choice.has(Quantity::CloudCondensate))
    choice.warnings.push_back(
        {"one_condensate",
         fmt::format("{} is liquid and ice in one field: it is split by temperature", leading.name)});
  keepUsed(choice);
  return choice;
}

}  // namespace cloudgen::input::model
