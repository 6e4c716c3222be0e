// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/cf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.hpp"
#include "input/netcdf/meanings.hpp"
#include "input/netcdf/validity.hpp"
#include "input/netcdf/vertical.hpp"

namespace cloudgen::input::netcdf {
namespace {

using field::Quantity;
using model::Single;
using model::SingleKind;

constexpr double kGravity = 9.80665;
/// Below this a height above ground is that of an instrument, not of a model level.
constexpr double kInstrumentMeters = 50;
constexpr std::size_t kMostMoments = 1 << 22, kMostMembers = 100000;
/// Of dry air, R / c_p.
constexpr double kKappa = 2.0 / 7.0;
constexpr double kPotentialPa = 100000;

/// A variable with all that it takes to read it.
struct Stored {
  std::shared_ptr<const File> file;
  Placed placed;
  Meaning meaning;
  std::shared_ptr<const Horizontal> horizontal;
};

using Cells = std::span<const std::uint32_t>;

std::vector<double> siValues(const Stored& stored, const Slice& slice, std::span<const Place> places) {
  std::vector<double> values = valuesAt(*stored.file, stored.placed, slice, places);
  const Conversion& toSi = stored.meaning.toSi;
  const double divisor = stored.meaning.treatment == Treatment::DividedByGravity ? kGravity : 1;
  for (double& value : values) {
    value = (value * toSi.factor + toSi.offset) / divisor;
    if (stored.meaning.treatment == Treatment::VapourPerDryAir) value = value / (1 + value);
  }
  return values;
}

std::vector<float> asFloats(const std::vector<double>& values) {
  std::vector<float> floats;
  floats.reserve(values.size());
  for (const double value : values)
    floats.push_back(std::abs(value) < std::numeric_limits<float>::max()
                         ? static_cast<float>(value)
                         : std::numeric_limits<float>::quiet_NaN());
  return floats;
}

bool isSingle(const Meaning& meaning) { return std::holds_alternative<Single>(meaning.what); }

bool means(const Stored& stored, Quantity quantity) {
  const auto* found = std::get_if<Quantity>(&stored.meaning.what);
  return found && *found == quantity;
}

class CfFile {
 public:
  CfFile(std::shared_ptr<const File> file, const OpenOptions& options, Builder& builder)
      : file_(std::move(file)), axes_(*file_), options_(options), builder_(builder) {}

  void add() {
    findVariables();
    dropSpareGround();
    for (const Stored& stored : stored_) addFields(stored);
    builder_.warn(warnings_);
  }

 private:
  void findVariables() {
    takeSurfacePressuresByFormula();
    std::vector<Stored> flat;
    for (const Variable& variable : file_->variables()) {
      if (!variable.isNumeric() || isCoordinate(variable)) continue;
      const auto placed = place(*file_, axes_, variable);
      if (!placed) continue;
      const auto meaning = meaningIn(*placed);
      if (!meaning) {
        noteUnused(variable, *placed);
        continue;
      }
      (placed->isHorizontal() ? stored_ : flat).push_back({file_, *placed, *meaning, nullptr});
    }
    // A file in which nothing has a place on a map is a single column.
    isColumn_ = stored_.empty();
    if (isColumn_) stored_ = std::move(flat);
    for (Stored& stored : stored_) {
      stored.horizontal = horizontalFor(stored.placed);
      if (!stored.meaning.warningId.empty()) builder_.warn(stored.meaning.warningId, stored.meaning.warning);
    }
  }

  bool isCoordinate(const Variable& variable) const {
    if (variable.attributes.contains("grid_mapping_name")) return true;
    if (variable.dimensions.size() == 1 &&
        variable.name == file_->dimensions()[variable.dimensions.front()].name)
      return true;
    const Kind kind = axes_.kind(variable);
    return kind != Kind::None && kind != Kind::Vertical;
  }

  bool isOnLevels(const Placed& placed) {
    if (placed.vertical) {
      // "height = 0 m" or 2 m of a single length marks a surface field (MET Norway).
      const std::size_t dimension = placed.variable->dimensions[*placed.vertical];
      const auto& found = levels(dimension).levels;
      return found.size() != 1 || found[0].kind != model::VerticalKind::HeightAboveGround ||
             found[0].value >= kInstrumentMeters;
    }
    std::vector<field::Warning> ignored;
    return !scalarLevel(*file_, *placed.variable, ignored).levels.empty();
  }

  std::optional<Meaning> meaningIn(const Placed& placed) {
    const Variable& variable = *placed.variable;
    if (surfacePressures_.contains(variable.name) && !placed.vertical) {
      Meaning meaning{Single{SingleKind::SurfacePressure}, Treatment::None, false, false, {}, {}, {}};
      if (const auto toPa = conversion(variable.text("units"), "Pa")) {
        meaning.toSi = *toPa;
        return meaning;
      }
    }
    if (isOnLevels(placed))
      if (const auto meaning = meaningOf(variable, true)) return meaning;
    const bool flat =
        !placed.vertical || file_->dimensions()[variable.dimensions[*placed.vertical]].length == 1;
    return flat ? meaningOf(variable, false) : std::nullopt;
  }

  void takeSurfacePressuresByFormula() {
    std::vector<field::Warning> ignored;
    for (std::size_t dimension = 0; dimension < file_->dimensions().size(); ++dimension)
      if (axes_.role(dimension) == Role::Vertical)
        if (const std::string name = levels(dimension).surfacePressure; !name.empty())
          surfacePressures_.insert(name);
  }

  const Levels& levels(std::size_t dimension) {
    const auto found = levelsOf_.find(dimension);
    if (found != levelsOf_.end()) return found->second;
    return levelsOf_.emplace(dimension, levelsAlong(*file_, axes_, dimension, warnings_)).first->second;
  }

  void noteUnused(const Variable& variable, const Placed& placed) {
    if (!placed.vertical) return;
    if (const std::string meaning = unusedMeaning(variable); !meaning.empty())
      builder_.addUnused(fmt::format("{}: {}", meaning, variable.name));
  }

  std::shared_ptr<const Horizontal> horizontalFor(const Placed& placed) {
    const Variable& variable = *placed.variable;
    std::string key;
    if (placed.isHorizontal()) {
      for (const auto& dimension : {placed.x, placed.y, placed.point})
        key += dimension ? fmt::format("{} ", variable.dimensions[*dimension]) : "- ";
      key += variable.text("grid_mapping") + " " + variable.text("coordinates");
    }
    auto& horizontal = horizontals_[key];
    if (!horizontal)
      horizontal = std::make_shared<const Horizontal>(placed.isHorizontal()
                                                          ? horizontalOf(*file_, axes_, placed, warnings_)
                                                          : columnOf(*file_, axes_, options_, warnings_));
    return horizontal;
  }

  /// Column files tell the ground's height twice, of the station and of the model; heights above ground are
  /// given with the station's.
  void dropSpareGround() {
    const auto isGround = [](const Stored& stored) {
      const auto* single = std::get_if<Single>(&stored.meaning.what);
      return single && single->kind == SingleKind::SurfaceHeight;
    };
    const auto isStation = [&](const Stored& stored) {
      return isGround(stored) && stored.placed.variable->name == "altitude";
    };
    if (!isColumn_ || std::none_of(stored_.begin(), stored_.end(), isStation)) return;
    std::erase_if(stored_, [&](const Stored& stored) { return isGround(stored) && !isStation(stored); });
  }

  /// Models on maps of their own mean winds along its axes unless they say "eastward".
  bool isTakenAlongAxes(const Stored& stored) {
    const Variable& variable = *stored.placed.variable;
    if (!means(stored, Quantity::WindEast) && !means(stored, Quantity::WindNorth)) return false;
    const std::string mapping = variable.text("grid_mapping");
    const Variable* map = file_->find(mapping.substr(0, mapping.find_first_of(" :")));
    if (!map || map->text("grid_mapping_name") == "latitude_longitude") return false;
    if (!variable.text("standard_name").empty() || !variable.text("GRIB_shortName").empty()) return false;
    builder_.warn(
        "wind_axes_assumed",
        fmt::format("{} does not say its direction: it is taken along the axes of the map", variable.name));
    return true;
  }

  std::size_t lengthOf(const Stored& stored, const std::optional<std::size_t>& dimension) const {
    return dimension ? file_->dimensions()[stored.placed.variable->dimensions[*dimension]].length : 1;
  }

  /// Readers that trust the usual order (time, level, latitude, longitude) take such a file for another sky.
  void warnOfOrder(const Placed& placed) {
    if (!placed.x || !placed.y) return;
    std::vector<std::size_t> usual;
    for (const auto& place : {placed.time, placed.vertical, placed.y, placed.x})
      if (place) usual.push_back(*place);
    if (std::is_sorted(usual.begin(), usual.end())) return;
    std::vector<std::string> names;
    for (const std::size_t dimension : placed.variable->dimensions)
      names.push_back(file_->dimensions()[dimension].name);
    builder_.warn("dimension_order", fmt::format("dimensions run {}: they are told by their coordinates",
                                                 fmt::join(names, ", ")));
  }

  void addFields(const Stored& stored) {
    warnOfOrder(stored.placed);
    const Variable& variable = *stored.placed.variable;
    if (lengthOf(stored, stored.placed.time) > kMostMoments ||
        lengthOf(stored, stored.placed.step) >
            kMostMoments / std::max<std::size_t>(1, lengthOf(stored, stored.placed.time)) ||
        lengthOf(stored, stored.placed.member) > kMostMembers)
      throw base::InputError(file_->where(variable), "is said to have absurdly many times",
                             "fetch the file again");
    const Validity validity(*file_, axes_, stored.placed, warnings_);
    Levels levels;
    if (!isSingle(stored.meaning))
      levels = stored.placed.vertical ? this->levels(variable.dimensions[*stored.placed.vertical])
                                      : scalarLevel(*file_, variable, warnings_);
    if (levels.levels.empty()) levels.levels.resize(1);
    const std::vector<long> members = membersOf(stored);
    const auto shared = std::make_shared<const Stored>(stored);
    model::Field field;
    field.meaning = stored.meaning.what;
    field.name = variable.name;
    field.where = file_->where(variable);
    field.grid = builder_.gridIndex(*stored.horizontal);
    field.inPercent = stored.meaning.inPercent;
    field.alongGridAxes = stored.meaning.alongGridAxes || isTakenAlongAxes(stored);
    for (std::size_t time = 0; time < lengthOf(stored, stored.placed.time); ++time)
      for (std::size_t step = 0; step < lengthOf(stored, stored.placed.step); ++step) {
        const Validity::Moment moment = validity.at(time, step);
        if (moment.lost) continue;
        field.valid = moment.valid;
        field.run = moment.run;
        // A file without any time holds for the time that is asked for.
        if (!field.valid && !isSingle(stored.meaning)) field.valid = timeOfTimeless();
        for (std::size_t member = 0; member < members.size(); ++member) {
          field.member = members[member];
          for (std::size_t level = 0; level < levels.levels.size(); ++level) {
            field.vertical = levels.levels[level];
            const Slice slice{time, step, member, level};
            field.read = reader(shared, slice, levels.levels[level]);
            if (field.read) builder_.add(field);
            if (!levels.heightA.empty()) addHeight(field, levels, level, slice);
          }
        }
      }
  }

  std::optional<base::UtcTime> timeOfTimeless() {
    if (options_.time) return options_.time;
    builder_.warn("time_missing",
                  "the file says no time: 1970-01-01T00:00:00Z is taken (--time chooses another)");
    return std::nullopt;
  }

  std::vector<long> membersOf(const Stored& stored) const {
    std::vector<long> members(lengthOf(stored, stored.placed.member));
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = static_cast<long>(i);
    if (!stored.placed.member) return members;
    const Variable* numbers =
        axes_.along(stored.placed.variable->dimensions[*stored.placed.member], {Kind::Member});
    if (!numbers) return members;
    const std::vector<double> values = file_->values(*numbers);
    for (std::size_t i = 0; i < members.size(); ++i)
      if (std::abs(values[i]) < 1e9) members[i] = std::lround(values[i]);
    return members;
  }

  using Read = std::function<std::vector<float>(Cells)>;

  /// Empty where the quantity cannot be made of what the file has.
  Read reader(const std::shared_ptr<const Stored>& stored, const Slice& slice, const model::Vertical& level) {
    switch (stored->meaning.treatment) {
      case Treatment::PotentialTemperature:
        return temperatureReader(stored, slice, level);
      case Treatment::PerDryAir:
        return dryReader(stored, slice);
      default:
        break;
    }
    return [stored, slice](Cells cells) {
      return asFloats(siValues(*stored, slice, stored->horizontal->places(cells)));
    };
  }

  const Stored* companion(const Stored& stored, Quantity quantity) const {
    const auto found = std::find_if(stored_.begin(), stored_.end(), [&](const Stored& other) {
      return means(other, quantity) &&
             other.placed.variable->dimensions == stored.placed.variable->dimensions;
    });
    return found == stored_.end() ? nullptr : &*found;
  }

  Read temperatureReader(const std::shared_ptr<const Stored>& stored, const Slice& slice,
                         const model::Vertical& level) {
    const Stored* pressure = companion(*stored, Quantity::Pressure);
    const double constant = level.kind == model::VerticalKind::Pressure ? level.value : 0;
    if (!pressure && constant <= 0) return {};
    const auto other = pressure ? std::make_shared<const Stored>(*pressure) : nullptr;
    return [stored, slice, other, constant](Cells cells) {
      const std::vector<Place> places = stored->horizontal->places(cells);
      std::vector<double> values = siValues(*stored, slice, places);
      const std::vector<double> pressures =
          other ? siValues(*other, slice, places) : std::vector<double>(values.size(), constant);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= std::pow(pressures[i] / kPotentialPa, kKappa);
      return asFloats(values);
    };
  }

  Read dryReader(const std::shared_ptr<const Stored>& stored, const Slice& slice) {
    const Stored* vapour = companion(*stored, Quantity::SpecificHumidity);
    const auto other = vapour ? std::make_shared<const Stored>(*vapour) : nullptr;
    return [stored, slice, other](Cells cells) {
      const std::vector<Place> places = stored->horizontal->places(cells);
      std::vector<double> values = siValues(*stored, slice, places);
      if (!other) return asFloats(values);
      // Of a kilogram of moist air 1 - q is dry.
      const std::vector<double> humidity = siValues(*other, slice, places);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(humidity[i])) values[i] *= 1 - humidity[i];
      return asFloats(values);
    };
  }

  /// The height of a hybrid-height level, once a level and time.
  void addHeight(model::Field field, const Levels& levels, std::size_t level, const Slice& slice) {
    if (!heightsAdded_.insert({field.grid, field.valid.value_or(base::UtcTime{}).seconds, level}).second)
      return;
    const auto ground = std::find_if(stored_.begin(), stored_.end(), [&](const Stored& stored) {
      return stored.placed.variable->name == levels.orography;
    });
    const double a = levels.heightA[level], b = levels.heightB.size() > level ? levels.heightB[level] : 0;
    const auto orography = ground == stored_.end() ? nullptr : std::make_shared<const Stored>(*ground);
    field.meaning = Quantity::Height;
    field.name = "formula_terms";
    field.inPercent = field.alongGridAxes = false;
    field.read = [a, b, orography, slice](Cells cells) {
      std::vector<double> heights(cells.size(), a);
      if (orography && b != 0) {
        const std::vector<double> surface = siValues(*orography, slice, orography->horizontal->places(cells));
        for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += b * surface[i];
      }
      return asFloats(heights);
    };
    builder_.add(field);
  }

  std::shared_ptr<const File> file_;
  Axes axes_;
  const OpenOptions& options_;
  Builder& builder_;
  std::vector<field::Warning> warnings_;
  std::vector<Stored> stored_;
  bool isColumn_ = false;
  std::set<std::string> surfacePressures_;
  std::map<std::size_t, Levels> levelsOf_;
  std::map<std::string, std::shared_ptr<const Horizontal>> horizontals_;
  std::set<std::tuple<std::size_t, std::int64_t, std::size_t>> heightsAdded_;
};

}  // namespace

void addCf(const std::shared_ptr<const File>& file, const OpenOptions& options, Builder& builder) {
  CfFile(file, options, builder).add();
}

}  // namespace cloudgen::input::netcdf
