// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <tuple>

#include "base/error.hpp"
#include "input/grib/grib.hpp"
#include "input/grib/handle.hpp"
#include "input/grib/meaning.hpp"
#include "input/grib/model_name.hpp"
#include "input/grib/stored_grid.hpp"

namespace cloudgen::input::grib {
namespace {

using field::Quantity;
using model::Field;
using model::Single;
using model::SingleKind;
using model::VerticalKind;

/// A grid that is worked out when it is first needed; fields share it.
class LazyGrid {
 public:
  explicit LazyGrid(FieldHead head) : head_(std::move(head)) {}
  const StoredGrid& get() {
    std::call_once(once_, [this] { grid_ = readGrid(head_); });
    return grid_;
  }

 private:
  FieldHead head_;
  std::once_flag once_;
  StoredGrid grid_;
};

float converted(double value, Conversion conversion) {
  constexpr double kGravity = 9.80665;
  if (conversion == Conversion::PerGravity) value /= kGravity;
  if (conversion == Conversion::MixingRatioToSpecific) value /= 1 + value;
  const bool fits = std::abs(value) < static_cast<double>(std::numeric_limits<float>::max());
  return fits ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
}

/// Where the values of a field are, and how they are read.
struct Stored {
  FieldLocation location;
  Conversion conversion = Conversion::None;
  std::shared_ptr<LazyGrid> grid;

  std::vector<float> at(std::span<const std::uint32_t> cells) const {
    const StoredGrid& stored = grid->get();
    const std::vector<double> all = decodedValues(location, stored.size());
    std::vector<float> chosen;
    chosen.reserve(cells.size());
    for (const std::uint32_t cell : cells) {
      assert(cell < stored.grid.size());
      chosen.push_back(converted(all[stored.place(cell)], conversion));
    }
    return chosen;
  }
};

/// A field with what decides whether it is kept.
struct Found {
  Field field;
  bool reserve = false;
};

class Reading {
 public:
  explicit Reading(const std::vector<std::filesystem::path>& files) {
    for (const auto& file : files) {
      contents_.files.push_back(file.string());
      for (const FieldHead& head : locateFields(file)) take(head);
    }
  }

  model::Contents contents() {
    const std::string where = contents_.files.size() == 1
                                  ? contents_.files.front()
                                  : fmt::format("{} GRIB files", contents_.files.size());
    if (messages_ == 0)
      throw base::InputError(where, "holds no GRIB message", "check that it is the right file");
    addLayerHeights();
    dropFewHeights();
    groundFromFirstLevel();
    keepBest();
    if (contents_.fields.empty())
      throw base::InputError(where, "says nothing about clouds or the air; it holds " + otherNames(),
                             "give a file with cloud water, humidity on levels, or cloud cover");
    contents_.format = editions_.size() > 1 ? "GRIB1 and GRIB2" : fmt::format("GRIB{}", *editions_.begin());
    for (const auto& [name, count] : falling_)
      contents_.unused.push_back(
          fmt::format("{}: {} field{}, falls and makes no cloud", name, count, count == 1 ? "" : "s"));
    return std::move(contents_);
  }

 private:
  void take(const FieldHead& head) {
    ++messages_;
    editions_.insert(head.location.edition);
    const Product product = readProduct(head);
    if (!product.plain || product.span == Span::Other) return;
    const Level level = levelOf(product);
    const std::optional<Parameter> parameter = knownParameter(head, product);
    if (!parameter) return;
    if (falls(parameter->what)) {
      if (level.place == Place::Level) ++falling_[std::string(parameter->name)];
      return;
    }
    const std::optional<Meaning> meaning = meaningOf(*parameter, level);
    const bool halfLevel = level.place == Place::HalfLevel && parameter->what == What::Height;
    if (!meaning && !halfLevel) return;
    Found found = fieldOf(head, product, *parameter, level);
    if (halfLevel) {
      halfLevels_.push_back({found.field, stored(head, Conversion::None, found.field.grid)});
      return;
    }
    found.field.meaning = meaning->what;
    found.reserve = meaning->reserve;
    const auto* single = std::get_if<Single>(&meaning->what);
    if (found.field.averaged && !single) return;
    if (single && single->kind == SingleKind::SurfaceHeight) found.field.valid.reset();
    found.field.read = [stored = stored(head, meaning->conversion, found.field.grid)](
                           std::span<const std::uint32_t> cells) { return stored.at(cells); };
    if (contents_.model.empty()) contents_.model = modelName(product);
    fields_.push_back(std::move(found));
  }

  /// ecCodes is asked once for each kind of field whose numbers are its centre's own.
  std::optional<Parameter> knownParameter(const FieldHead& head, const Product& product) {
    if (const auto parameter = parameterOf(product)) return parameter;
    const std::array key{product.edition,  product.centre, product.table,    product.discipline,
                         product.category, product.number, product.firstType};
    auto [place, isNew] = strangers_.emplace(key, Stranger{head, std::nullopt});
    if (isNew && hasOwnNumbers(product)) place->second.parameter = parameterNamed(shortNameOf(head));
    return place->second.parameter;
  }

  Found fieldOf(const FieldHead& head, const Product& product, const Parameter& parameter,
                const Level& level) {
    Found found;
    Field& field = found.field;
    field.name = parameter.name;
    field.where = head.location.name();
    field.vertical = level.vertical;
    field.valid = product.valid;
    field.run = product.run;
    field.member = product.member;
    field.inPercent = parameter.inPercent;
    const bool wind = parameter.what == What::WindEast || parameter.what == What::WindNorth;
    field.alongGridAxes = wind && windsAlongAxes(head);
    field.grid = gridIndex(head);
    field.averaged = product.span == Span::Average;
    return found;
  }

  std::size_t gridIndex(const FieldHead& head) {
    const auto [place, isNew] = gridIndices_.emplace(gridKey(head), grids_.size());
    if (isNew) {
      auto grid = std::make_shared<LazyGrid>(head);
      grids_.push_back(grid);
      contents_.grids.emplace_back([grid] { return grid->get().grid; });
    }
    return place->second;
  }

  Stored stored(const FieldHead& head, Conversion conversion, std::size_t grid) {
    return {head.location, conversion, grids_[grid]};
  }

  /// Generalised vertical layers: their height is the mean of those of the half levels above and below, which
  /// are numbered like the layers, from the top.
  void addLayerHeights() {
    std::map<std::tuple<std::size_t, long, double>, const HalfLevel*> byNumber;
    for (const HalfLevel& half : halfLevels_)
      byNumber.emplace(std::tuple(half.field.grid, half.field.member, half.field.vertical.value), &half);
    for (const auto& [key, above] : byNumber) {
      const auto& [grid, member, number] = key;
      const auto next = byNumber.find({grid, member, number + 1});
      if (next == byNumber.end()) continue;
      Found found{above->field};
      found.field.meaning = Quantity::Height;
      found.field.valid.reset();
      found.field.read = [upper = above->stored,
                          lower = next->second->stored](std::span<const std::uint32_t> cells) {
        std::vector<float> heights = upper.at(cells);
        const std::vector<float> below = lower.at(cells);
        for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = 0.5f * (heights[i] + below[i]);
        return heights;
      };
      fields_.push_back(std::move(found));
    }
  }

  /// Screen temperature, winds near the ground and the like are no model levels: kinds of level count where
  /// water, cover or humidity stands on several.
  void dropFewHeights() {
    constexpr std::size_t kFew = 3;
    std::map<std::pair<VerticalKind, Quantity>, std::set<double>> levels;
    for (const Found& found : fields_)
      if (const auto* quantity = std::get_if<Quantity>(&found.field.meaning))
        levels[{found.field.vertical.kind, *quantity}].insert(found.field.vertical.value);
    const auto isModel = [&](VerticalKind kind) {
      for (const Quantity quantity :
           {Quantity::CloudCondensate, Quantity::CloudLiquid, Quantity::CloudIce, Quantity::CloudFraction,
            Quantity::RelativeHumidity, Quantity::SpecificHumidity}) {
        const auto found = levels.find({kind, quantity});
        if (found != levels.end() && found->second.size() >= kFew) return true;
      }
      return false;
    };
    std::set<VerticalKind> dropped;
    for (const VerticalKind kind :
         {VerticalKind::HeightAboveSea, VerticalKind::HeightAboveGround, VerticalKind::Sigma})
      if (!isModel(kind)) dropped.insert(kind);
    std::erase_if(fields_, [&](const Found& found) {
      return std::holds_alternative<Quantity>(found.field.meaning) &&
             dropped.contains(found.field.vertical.kind);
    });
  }

  /// ECMWF gives the geopotential of the ground on the first model level.
  void groundFromFirstLevel() {
    const auto onHybrid = [](const Found& found) {
      const auto* quantity = std::get_if<Quantity>(&found.field.meaning);
      return quantity && *quantity == Quantity::GeopotentialHeight && found.field.name == "z" &&
             (found.field.vertical.kind == VerticalKind::Hybrid ||
              found.field.vertical.kind == VerticalKind::ModelLevel);
    };
    const bool alone = std::none_of(fields_.begin(), fields_.end(), [&](const Found& found) {
      return onHybrid(found) && found.field.vertical.value != 1;
    });
    if (!alone) return;
    for (Found& found : fields_)
      if (onHybrid(found)) {
        found.field.meaning = Single{SingleKind::SurfaceHeight};
        found.field.valid.reset();
      }
  }

  /// Averages and second bests go where something better has their meaning.
  void keepBest() {
    using Key = std::tuple<Single, std::int64_t, long, std::size_t>;
    const auto keyOf = [](const Found& found) {
      const Field& field = found.field;
      return Key{std::get<Single>(field.meaning), field.valid ? field.valid->seconds : 0, field.member,
                 field.grid};
    };
    const auto rank = [](const Found& found) { return 2 * found.field.averaged + found.reserve; };
    std::map<Key, int> best;
    for (const Found& found : fields_)
      if (std::holds_alternative<Single>(found.field.meaning)) {
        const auto [place, isNew] = best.emplace(keyOf(found), rank(found));
        place->second = std::min(place->second, rank(found));
      }
    for (Found& found : fields_)
      if (!std::holds_alternative<Single>(found.field.meaning) || rank(found) == best.at(keyOf(found)))
        contents_.fields.push_back(std::move(found.field));
  }

  /// The first few names of what a file holds that is of no use.
  std::string otherNames() const {
    constexpr std::size_t kMost = 12;
    std::set<std::string> names;
    for (const auto& [key, stranger] : strangers_)
      if (names.size() <= kMost) names.insert(shortNameOf(stranger.head));
    for (const auto& [name, count] : falling_) names.insert(name);
    if (names.empty()) return "fields that are no state of the air at a moment";
    const std::size_t others = names.size() > kMost ? names.size() - kMost : 0;
    std::vector<std::string> shown(
        names.begin(), std::next(names.begin(), static_cast<std::ptrdiff_t>(names.size() - others)));
    return fmt::format("{}{}", fmt::join(shown, ", "), others ? fmt::format(" and {} others", others) : "");
  }

  /// A kind of field that the numbers do not tell.
  struct Stranger {
    FieldHead head;
    std::optional<Parameter> parameter;
  };
  struct HalfLevel {
    Field field;
    Stored stored;
  };

  model::Contents contents_;
  std::size_t messages_ = 0;
  std::set<int> editions_;
  std::vector<Found> fields_;
  std::vector<HalfLevel> halfLevels_;
  std::vector<std::shared_ptr<LazyGrid>> grids_;
  std::map<std::string, std::size_t> gridIndices_;
  std::map<std::array<int, 7>, Stranger> strangers_;
  std::map<std::string, std::size_t> falling_;
};

}  // namespace

model::Contents readContents(const std::vector<std::filesystem::path>& files) {
  assert(!files.empty());
  return Reading(files).contents();
}

}  // namespace cloudgen::input::grib
