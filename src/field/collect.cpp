// SPDX-License-Identifier: Apache-2.0
#include "field/collect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "field/cloud_water.hpp"
#include "field/column_state.hpp"

namespace cloudgen::field {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// A level and what follows from it, one value a column.
struct Slab {
  std::uint32_t number = 0;
  Level level;
  AirLevel air;
  std::vector<float> heightMeters, relativeHumidity;

  float value(Quantity quantity, std::size_t column) const {
    const auto found = level.values.find(quantity);
    return found == level.values.end() ? kMissing : found->second[column];
  }
};

/// A cloudy cell before its fraction is settled; water as grid mean, kg/kg.
struct PendingCell {
  std::uint32_t column = 0;
  CloudCell cell;
  float liquid = 0, ice = 0, airDensity = 0;
  float givenFraction = kMissing, derivedFraction = 0;
};

struct Water {
  float liquid = 0, ice = 0;
  float total() const { return liquid + ice; }
};

float positive(float value) { return value > 0 ? value : 0; }

/// The value, or missing where no air of this planet could have it.
float within(float value, float low, float high) { return value >= low && value <= high ? value : kMissing; }

bool hasCloudWater(const Level& level) {
  return level.has(Quantity::CloudLiquid) || level.has(Quantity::CloudIce) ||
         level.has(Quantity::CloudCondensate);
}

/// Liquid and ice of a cell; condensate in one field is split by temperature.
Water waterOf(const Slab& slab, std::size_t column) {
  if (slab.level.has(Quantity::CloudLiquid) || slab.level.has(Quantity::CloudIce))
    return {positive(slab.value(Quantity::CloudLiquid, column)),
            positive(slab.value(Quantity::CloudIce, column))};
  const float condensate = positive(slab.value(Quantity::CloudCondensate, column));
  const auto liquid = static_cast<float>(condensate * liquidShare(slab.air.temperatureK[column]));
  return {liquid, condensate - liquid};
}

struct Borders {
  float base = 0, top = 0;
};

/// Half-way to the neighbouring levels; where one is missing, as far as to the other side.
std::optional<Borders> bordersOf(const Slab* below, const Slab& here, const Slab* above, std::size_t column) {
  const float height = here.heightMeters[column];
  float down = below ? height - below->heightMeters[column] : kMissing;
  float up = above ? above->heightMeters[column] - height : kMissing;
  if (!(down > 0)) down = up;
  if (!(up > 0)) up = down;
  if (!(down > 0)) return std::nullopt;
  return Borders{height - 0.5f * down, height + 0.5f * up};
}

class Collector {
 public:
  Collector(const Source& source, const std::vector<std::uint32_t>& cells)
      : source_(source), surface_(source.surface(cells)) {
    result_.grid = source.grid();
    result_.columns = cells;
    result_.states.assign(cells.size(), unknownState());
    for (std::size_t c = 0; c < surface_.heightMeters.size(); ++c)
      result_.states[c].surfaceHeightMeters = surface_.heightMeters[c];
  }

  void add(const Level& level) {
    Slab next = slabOf(level);
    if (here_) {
      fillStandardLevels(here_->air, next.air, result_.states);
      close(&next);
    }
    below_ = std::move(here_);
    here_ = std::move(next);
  }

  CloudColumns finish() {
    if (!cloudWaterSeen_)
      throw base::InputError(where(), "has no cloud water on any level",
                             "give model output with cloud water or cloud ice on levels");
    if (levels_ < 2)
      throw base::InputError(where(), "has a single level",
                             "give at least two levels, so that cloud depth is known");
    close(nullptr);
    for (ColumnState& state : result_.states) state.kIndexC = kIndex(state);
    settleFractions();
    return std::move(result_);
  }

 private:
  std::string where() const { return source_.info().files.empty() ? "input" : source_.info().files.front(); }

  void require(const Level& level, bool present, std::string_view what) const {
    if (present) return;
    throw base::InputError(fmt::format("{}, level {:g} hPa", where(), level.pressurePa / 100),
                           fmt::format("has cloud water but no {}", what),
                           "extract that field on the same levels too");
  }

  Slab slabOf(const Level& level) {
    Slab slab{levels_++, level, {}, {}, {}};
    if (hasCloudWater(level)) {
      cloudWaterSeen_ = true;
      require(level, level.has(Quantity::Temperature), "temperature");
      require(level, level.has(Quantity::GeopotentialHeight), "geopotential height");
      require(level,
              level.has(Quantity::CloudFraction) || level.has(Quantity::RelativeHumidity) ||
                  level.has(Quantity::SpecificHumidity),
              "cloud fraction, nor a humidity to derive it from");
    }
    const std::size_t count = result_.columns.size();
    for (auto* values : {&slab.air.pressurePa, &slab.air.temperatureK, &slab.air.dewPointK,
                         &slab.heightMeters, &slab.relativeHumidity})
      values->resize(count, kMissing);
    for (std::size_t c = 0; c < count; ++c) fillColumn(slab, c);
    return slab;
  }

  void fillColumn(Slab& slab, std::size_t c) {
    const float pressure = slab.value(Quantity::Pressure, c);
    slab.air.pressurePa[c] = pressure > 0 ? pressure : static_cast<float>(slab.level.pressurePa);
    const float temperature = within(slab.value(Quantity::Temperature, c), 100, 400);
    slab.air.temperatureK[c] = temperature;
    slab.relativeHumidity[c] = humidityOf(slab, c);
    if (slab.relativeHumidity[c] > 0)
      slab.air.dewPointK[c] = static_cast<float>(dewPoint(temperature, slab.relativeHumidity[c]));
    const float geopotential = within(slab.value(Quantity::GeopotentialHeight, c), -2000, 100000);
    slab.heightMeters[c] = static_cast<float>(geometricHeight(geopotential, latitudeOf(c)));
    float& surface = result_.states[c].surfaceHeightMeters;
    if (!std::isfinite(surface)) surface = slab.heightMeters[c];
  }

  float humidityOf(const Slab& slab, std::size_t c) const {
    const float relative = slab.value(Quantity::RelativeHumidity, c);
    if (std::isfinite(relative)) return std::clamp(relative, 0.0f, 2.0f);
    const float specific = slab.value(Quantity::SpecificHumidity, c);
    const float temperature = slab.air.temperatureK[c];
    if (!std::isfinite(specific) || !std::isfinite(temperature)) return kMissing;
    return static_cast<float>(positive(specific) /
                              saturationSpecificHumidity(slab.air.pressurePa[c], temperature));
  }

  double latitudeOf(std::size_t column) const {
    return centerOf(result_.grid, result_.columns[column]).latitudeDegrees;
  }

  bool belowSurface(const Slab& slab, std::size_t c) const {
    const bool deeper = !surface_.pressurePa.empty() && slab.air.pressurePa[c] > surface_.pressurePa[c];
    const bool lower = !surface_.heightMeters.empty() && slab.heightMeters[c] < surface_.heightMeters[c];
    return deeper || lower;
  }

  /// Keeps the cloudy cells of the level in the middle.
  void close(const Slab* above) {
    const Slab& here = *here_;
    if (!hasCloudWater(here.level)) return;
    for (std::size_t c = 0; c < result_.columns.size(); ++c) {
      if (!std::isfinite(here.air.temperatureK[c]) || belowSurface(here, c)) continue;
      const Water water = waterOf(here, c);
      if (water.total() <= kCloudyMixingRatio || !std::isfinite(water.total())) continue;
      const auto borders = bordersOf(below_ ? &*below_ : nullptr, here, above, c);
      if (!borders) continue;
      const float floor = surface_.heightMeters.empty() ? kMissing : surface_.heightMeters[c];
      const float base = borders->base < floor ? floor : borders->base;
      if (borders->top > base) keep(here, c, {base, borders->top}, water);
    }
  }

  void keep(const Slab& slab, std::size_t c, const Borders& borders, const Water& water) {
    const double pressure = slab.air.pressurePa[c], temperature = slab.air.temperatureK[c];
    const double saturation = saturationSpecificHumidity(pressure, temperature);
    // Cloud without a known humidity is taken as saturated air.
    const float humidity = std::isfinite(slab.relativeHumidity[c]) ? slab.relativeHumidity[c] : 1.0f;
    const float specific = slab.value(Quantity::SpecificHumidity, c);
    PendingCell pending;
    pending.column = static_cast<std::uint32_t>(c);
    pending.liquid = water.liquid;
    pending.ice = water.ice;
    pending.airDensity = static_cast<float>(
        airDensity(pressure, temperature, std::isfinite(specific) ? specific : humidity * saturation));
    pending.givenFraction = std::clamp(slab.value(Quantity::CloudFraction, c), 0.0f, 1.0f);
    pending.derivedFraction = static_cast<float>(cloudFractionXuRandall(humidity, water.total(), saturation));
    const auto wind = [&](Quantity quantity) {
      const float value = within(slab.value(quantity, c), -200, 200);
      return std::isfinite(value) ? value : 0.0f;
    };
    pending.cell = {.level = slab.number,
                    .baseMeters = borders.base,
                    .topMeters = borders.top,
                    .temperatureK = slab.air.temperatureK[c],
                    .relativeHumidity = humidity,
                    .windEast = wind(Quantity::WindEast),
                    .windNorth = wind(Quantity::WindNorth),
                    .pressurePa = slab.air.pressurePa[c]};
    result_.phaseDerived |= !slab.level.has(Quantity::CloudLiquid) && !slab.level.has(Quantity::CloudIce);
    pending_.push_back(pending);
  }

  /// Settles fraction and in-cloud extinction, and sorts the cells by column.
  void settleFractions() {
    const bool fractionGiven = std::any_of(pending_.begin(), pending_.end(), [](const PendingCell& pending) {
      return pending.givenFraction > 0;
    });
    std::erase_if(pending_, [&](PendingCell& pending) { return !settle(pending, fractionGiven); });
    result_.start.assign(result_.columns.size() + 1, 0);
    for (const PendingCell& pending : pending_) ++result_.start[pending.column + 1];
    for (std::size_t c = 0; c < result_.columns.size(); ++c) result_.start[c + 1] += result_.start[c];
    std::vector<std::uint32_t> next(result_.start.begin(), result_.start.end() - 1);
    result_.cells.resize(pending_.size());
    for (const PendingCell& pending : pending_) result_.cells[next[pending.column]++] = pending.cell;
  }

  /// False where the cell turns out to be clear.
  bool settle(PendingCell& pending, bool fractionGiven) {
    const bool given = fractionGiven && std::isfinite(pending.givenFraction);
    const float fraction = given ? pending.givenFraction : pending.derivedFraction;
    if (fraction < kLeastFraction) return false;
    result_.fractionDerived |= !given;
    CloudCell& cell = pending.cell;
    cell.fraction = std::min(1.0f, std::max(fraction, (pending.liquid + pending.ice) / kMostInCloudWater));
    const double perFraction = pending.airDensity / cell.fraction;
    cell.liquidExtinctionPerMeter = static_cast<float>(liquidExtinction(pending.liquid * perFraction));
    cell.iceExtinctionPerMeter =
        static_cast<float>(iceExtinction(pending.ice * perFraction, cell.temperatureK));
    return true;
  }

  const Source& source_;
  Surface surface_;
  CloudColumns result_;
  std::optional<Slab> below_, here_;
  std::vector<PendingCell> pending_;
  std::uint32_t levels_ = 0;
  bool cloudWaterSeen_ = false;
};

}  // namespace

CloudColumns collectColumns(const Source& source, const std::vector<std::uint32_t>& cells) {
  Collector collector(source, cells);
  source.visitLevels(cells, [&](const Level& level) { collector.add(level); });
  return collector.finish();
}

}  // namespace cloudgen::field
