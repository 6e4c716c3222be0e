// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/wrf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "input/netcdf/slab.hpp"
#include "input/netcdf/times.hpp"
#include "input/netcdf/units.hpp"
#include "input/netcdf/wrf_grid.hpp"

namespace cloudgen::input::netcdf {
namespace {

using field::Quantity;
using model::Single;
using model::SingleKind;
using Cells = std::span<const std::uint32_t>;
using Values = std::vector<double>;

/// WRF's own constants: potential temperature is kept less 300 K, Exner's exponent is R / c_p with
/// R = 287 and c_p = 7 R / 2 (Skamarock et al. 2008, NCAR/TN-475, ch. 2).
constexpr double kBaseTemperatureK = 300, kReferencePa = 100000, kKappa = 2.0 / 7.0;
constexpr double kGravity = 9.80665;
/// MP_PHYSICS of the three-class scheme of Hong et al. 2004.
constexpr double kWsm3 = 3;

enum class Middle { None, Column, Row, Level };

/// A variable of a wrfout file; the dimensions are told by their names.
struct Stored {
  std::shared_ptr<const File> file;
  Placed placed;
  Middle middle = Middle::None;

  /// At cells; staggered ones are the mean of the two borders of the cell.
  Values at(const Horizontal& grid, std::size_t time, std::size_t level, Cells cells) const {
    std::vector<Place> places = grid.places(cells);
    Slice slice{time, 0, 0, level};
    Values values = valuesAt(*file, placed, slice, places);
    if (middle == Middle::None) return values;
    if (middle == Middle::Level) ++slice.level;
    for (Place& place : places) {
      place.column += middle == Middle::Column;
      place.row += middle == Middle::Row;
    }
    const Values others = valuesAt(*file, placed, slice, places);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5 * (values[i] + others[i]);
    return values;
  }
};

using Source = std::shared_ptr<const Stored>;
using Read = std::function<Values(std::size_t time, std::size_t level, Cells cells)>;

class WrfFile {
 public:
  WrfFile(std::shared_ptr<const File> file, Builder& builder)
      : file_(std::move(file)),
        builder_(builder),
        grid_(std::make_shared<const Horizontal>(wrfGrid(*file_, builder))),
        gridIndex_(builder.gridIndex(*grid_)) {}

  void add() {
    readTimes();
    addStates();
    addWater();
    addWinds();
    addSurface();
    for (const auto& [name, meaning] : {std::pair{"QRAIN", "rain"},
                                        {"QSNOW", "snow"},
                                        {"QGRAUP", "graupel"},
                                        {"QHAIL", "hail"},
                                        {"W", "upward wind in m/s"}})
      if (file_->find(name)) builder_.addUnused(fmt::format("{}: {}", meaning, name));
  }

 private:
  /// Null if the file does not have it.
  Source stored(const char* name) const {
    const Variable* variable = file_->find(name);
    if (!variable || !variable->isNumeric()) return nullptr;
    Stored found{file_, {}, Middle::None};
    found.placed.variable = variable;
    for (std::size_t i = 0; i < variable->dimensions.size(); ++i) {
      const std::string& dimension = file_->dimensions()[variable->dimensions[i]].name;
      const bool staggered = dimension.ends_with("_stag");
      if (dimension == "Time") found.placed.time = i;
      if (dimension.starts_with("bottom_top")) found.placed.vertical = i;
      if (dimension.starts_with("south_north")) found.placed.y = i;
      if (dimension.starts_with("west_east")) found.placed.x = i;
      if (staggered)
        found.middle =
            found.placed.x == i ? Middle::Column : (found.placed.y == i ? Middle::Row : Middle::Level);
    }
    return found.placed.x && found.placed.y ? std::make_shared<const Stored>(found) : nullptr;
  }

  std::size_t lengthOf(const char* dimension) const {
    for (const Dimension& found : file_->dimensions())
      if (found.name == dimension) return found.length;
    return 0;
  }

  void readTimes() {
    if (const Variable* texts = file_->find("Times"))
      for (const std::string& text : file_->texts(*texts)) times_.push_back(wrfTime(text));
    std::vector<field::Warning> warnings;
    const Variable* numbers = file_->find("XTIME");
    if (times_.empty() && numbers && file_->size(*numbers) < 1'000'000)
      times_ = moments(*file_, *numbers, warnings);
    builder_.warn(warnings);
    run_ = wrfTime(file_->text("SIMULATION_START_DATE"));
    if (!run_) run_ = wrfTime(file_->text("START_DATE"));
    times_.resize(std::min<std::size_t>(lengthOf("Time"), 1'000'000));
    if (times_.empty()) throw base::InputError(file_->name(), "holds no time", "give a complete wrfout file");
  }

  void addAll(const std::variant<Quantity, Single>& meaning, const std::string& name, const Read& read,
              const std::function<void(model::Field&)>& mark = {}) {
    const bool onLevels = std::holds_alternative<Quantity>(meaning);
    const std::size_t levels = onLevels ? lengthOf("bottom_top") : 1;
    if (levels > 10000)
      throw base::InputError(file_->name(), "is said to have absurdly many levels", "fetch the file again");
    model::Field field;
    field.meaning = meaning;
    field.name = name;
    field.where = fmt::format("{}, variable {}", file_->name(), name);
    field.run = run_;
    field.grid = gridIndex_;
    if (mark) mark(field);
    for (std::size_t time = 0; time < times_.size(); ++time) {
      if (!times_[time]) continue;
      field.valid = times_[time];
      for (std::size_t level = 0; level < levels; ++level) {
        if (onLevels)
          field.vertical = {model::VerticalKind::ModelLevel, static_cast<double>(level + 1), 0, 0};
        field.read = [read, time, level](Cells cells) {
          std::vector<float> floats;
          floats.reserve(cells.size());
          for (const double value : read(time, level, cells))
            floats.push_back(std::abs(value) < std::numeric_limits<float>::max()
                                 ? static_cast<float>(value)
                                 : std::numeric_limits<float>::quiet_NaN());
          return floats;
        };
        builder_.add(field);
      }
    }
  }

  Read plain(const Source& source) const {
    return [source, grid = grid_](std::size_t time, std::size_t level, Cells cells) {
      return source->at(*grid, time, level, cells);
    };
  }

  Read sum(const Source& a, const Source& b, double factor) const {
    return [a, b, factor, grid = grid_](std::size_t time, std::size_t level, Cells cells) {
      Values values = a->at(*grid, time, level, cells);
      const Values others = b->at(*grid, time, level, cells);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = factor * (values[i] + others[i]);
      return values;
    };
  }

  void addStates() {
    const Source p = stored("P"), pb = stored("PB"), ph = stored("PH"), phb = stored("PHB"), t = stored("T");
    if (ph && phb) addAll(Quantity::GeopotentialHeight, "PH + PHB", sum(ph, phb, 1 / kGravity));
    if (!p || !pb) return;
    const Read pressure = sum(p, pb, 1);
    addAll(Quantity::Pressure, "P + PB", pressure);
    if (!t) return;
    const Read theta = plain(t);
    addAll(Quantity::Temperature, "T", [pressure, theta](std::size_t time, std::size_t level, Cells cells) {
      Values values = theta(time, level, cells);
      const Values pressures = pressure(time, level, cells);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = (values[i] + kBaseTemperatureK) * std::pow(pressures[i] / kReferencePa, kKappa);
      return values;
    });
  }

  /// Mixing ratios are per kg of dry air; of a kilogram of moist air 1 / (1 + QVAPOR) is dry.
  Read perMoistAir(const Source& water, const Source& vapour) const {
    const Read mixingRatio = plain(water);
    if (!vapour) return mixingRatio;
    const Read vapourRatio = plain(vapour);
    return [mixingRatio, vapourRatio](std::size_t time, std::size_t level, Cells cells) {
      Values values = mixingRatio(time, level, cells);
      const Values ratios = vapourRatio(time, level, cells);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] /= 1 + ratios[i];
      return values;
    };
  }

  void addWater() {
    const Source vapour = stored("QVAPOR"), liquid = stored("QCLOUD"), ice = stored("QICE");
    if (vapour) addAll(Quantity::SpecificHumidity, "QVAPOR", perMoistAir(vapour, vapour));
    const bool holdsIce = !ice && (file_->number("MP_PHYSICS") == kWsm3 || !file_->number("MP_PHYSICS"));
    if (liquid)
      addAll(Quantity::CloudLiquid, "QCLOUD", perMoistAir(liquid, vapour),
             [&](model::Field& field) { field.holdsIceBelowFreezing = holdsIce; });
    if (liquid && holdsIce)
      builder_.warn(
          "liquid_holds_ice",
          "QCLOUD has no QICE beside it (as in WSM3): it is taken as ice where the air is below 0 C");
    if (ice) addAll(Quantity::CloudIce, "QICE", perMoistAir(ice, vapour));
    if (const Source fraction = stored("CLDFRA")) addAll(Quantity::CloudFraction, "CLDFRA", plain(fraction));
  }

  void addWinds() {
    const auto alongAxes = [](model::Field& field) { field.alongGridAxes = true; };
    if (const Source u = stored("U")) addAll(Quantity::WindEast, "U", plain(u), alongAxes);
    if (const Source v = stored("V")) addAll(Quantity::WindNorth, "V", plain(v), alongAxes);
  }

  void addSurface() {
    if (const Source ground = stored("HGT")) addAll(Single{SingleKind::SurfaceHeight}, "HGT", plain(ground));
    if (const Source pressure = stored("PSFC"))
      addAll(Single{SingleKind::SurfacePressure}, "PSFC", plain(pressure));
  }

  std::shared_ptr<const File> file_;
  Builder& builder_;
  std::shared_ptr<const Horizontal> grid_;
  std::size_t gridIndex_;
  std::vector<std::optional<base::UtcTime>> times_;
  std::optional<base::UtcTime> run_;
};

}  // namespace

bool isWrf(const File& file) {
  const Variable *latitude = file.find("XLAT"), *longitude = file.find("XLONG");
  return latitude && longitude && latitude->isNumeric() && longitude->isNumeric() && file.number("MAP_PROJ");
}

void addWrf(const std::shared_ptr<const File>& file, Builder& builder) { WrfFile(file, builder).add(); }

}  // namespace cloudgen::input::netcdf
