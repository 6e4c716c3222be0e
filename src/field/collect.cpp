// SPDX-License-Identifier: Apache-2.0
#include "field/collect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/error.hpp"
#include "field/air.hpp"
#include "field/cloud_water.hpp"
#include "field/column_state.hpp"
#include "field/hypsometry.hpp"
#include "field/level_gaps.hpp"
#include "field/settle.hpp"

namespace cloudgen::field {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// A level and its air.
struct Slab {
  std::uint32_t number = 0;
  Level level;
  AirLevel air;

  float value(Quantity quantity, std::size_t column) const {
    const auto found = level.values.find(quantity);
    return found == level.values.end() ? kMissing : found->second[column];
  }
};

struct Water {
  float liquid = 0, ice = 0;
  float total() const { return liquid + ice; }
};

float positive(float value) { return value > 0 ? value : 0; }

/// The value, or missing where no air of this planet could have it.
float within(float value, float low, float high) { return value >= low && value <= high ? value : kMissing; }

bool isCondensate(Quantity quantity) {
  return quantity == Quantity::CloudLiquid || quantity == Quantity::CloudIce ||
         quantity == Quantity::CloudCondensate;
}

bool tellsHumidCloud(Quantity quantity) {
  return quantity == Quantity::RelativeHumidity || quantity == Quantity::SpecificHumidity ||
         quantity == Quantity::CloudFraction;
}

bool hasAny(const LevelPlan& plan, bool (*wanted)(Quantity)) {
  return std::any_of(plan.levels.begin(), plan.levels.end(),
                     [&](const auto& level) { return std::any_of(level.begin(), level.end(), wanted); });
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

/// Half-way to the neighbouring levels (empty: there is none); where one is missing, as far as to the other
/// side.
std::optional<Borders> bordersBetween(const std::vector<float>& below, float height,
                                      const std::vector<float>& above, std::size_t column) {
  float down = below.empty() ? kMissing : height - below[column];
  float up = above.empty() ? kMissing : above[column] - height;
  if (!(down > 0)) down = up;
  if (!(up > 0)) up = down;
  if (!(down > 0)) return std::nullopt;
  return Borders{height - 0.5f * down, height + 0.5f * up};
}

/// 50 hPa to either side; 300 m where the air is too thin for that.
Borders bordersAlone(const AirLevel& air, std::size_t column) {
  constexpr float kPascals = 5000, kMeters = 300;
  const float height = air.heightMeters[column], pressure = air.pressurePa[column];
  if (!(pressure > 2 * kPascals)) return {height - kMeters, height + kMeters};
  const double kelvin = air.temperatureK[column];
  return {height - static_cast<float>(thickness(pressure + kPascals, pressure, kelvin)),
          height + static_cast<float>(thickness(pressure, pressure - kPascals, kelvin))};
}

/// Between the columns whose wind is kept; shares no factor with the rows, so that they lie on slanted lines.
std::size_t strideOver(const Grid& grid, std::size_t columns) {
  std::size_t stride = (columns + kWindColumns - 1) / kWindColumns;
  while (stride > 1 && std::gcd(stride, static_cast<std::size_t>(std::max(grid.columns, 1))) > 1) ++stride;
  return std::max<std::size_t>(stride, 1);
}

class Collector {
 public:
  Collector(const Source& source, const std::vector<std::uint32_t>& cells, const LevelPlan& plan,
            Derivations& derivations)
      : surface_(source.surface(cells)),
        derivations_(derivations),
        airMaker_(source.grid(), cells, surface_, derivations),
        hasCondensate_(hasAny(plan, isCondensate)),
        hasHumidity_(plan.has(Quantity::RelativeHumidity) || plan.has(Quantity::SpecificHumidity)),
        windStride_(strideOver(source.grid(), cells.size())) {
    if (!hasCondensate_ && !hasAny(plan, tellsHumidCloud))
      throw base::InputError(source.info().files.empty() ? "input" : source.info().files.front(),
                             "has neither cloud water nor humidity on any level",
                             "give model output with cloud water, cloud ice or relative humidity on levels");
    result_.grid = source.grid();
    result_.columns = cells;
    result_.states.assign(cells.size(), unknownState());
    precipitableWater_.assign(cells.size(), 0);
  }

  void add(Level level) {
    if (next_) take(std::move(*next_), &level);
    next_ = std::move(level);
  }

  CloudColumns finish() {
    if (next_) take(std::move(*next_), nullptr);
    if (here_) close({});
    for (std::size_t c = 0; c < result_.states.size(); ++c) {
      ColumnState& state = result_.states[c];
      state.kIndexC = kIndex(state);
      if (const float ground = airMaker_.groundMeters()[c]; std::isfinite(ground))
        state.surfaceHeightMeters = ground;
    }
    if (hasCondensate_)
      settleGivenWater(std::move(pending_), hasHumidity_, result_, derivations_);
    else
      settleDiagnosedWater(std::move(pending_), precipitableWater_, result_, derivations_);
    result_.derived = derivations_.lines();
    return std::move(result_);
  }

 private:
  /// The level's air is known when the next level is; its cells are when the next level's air is.
  void take(Level level, const Level* above) {
    Slab slab{levels_++, std::move(level), {}};
    slab.air = airMaker_.next(slab.level, above);
    // Isobaric levels do not follow the ground: where nothing tells it, it is at sea level.
    const float highest = slab.level.pressurePa > 0 ? 0 : std::numeric_limits<float>::max();
    for (std::size_t c = 0; c < result_.states.size(); ++c)
      if (float& surface = result_.states[c].surfaceHeightMeters; !std::isfinite(surface))
        surface = std::min(slab.air.heightMeters[c], highest);
    if (here_) {
      fillStandardLevels(here_->air, slab.air, result_.states);
      addPrecipitableWater(here_->air, slab.air);
      close(slab.air.heightMeters);
      heightsBelow_ = std::move(here_->air.heightMeters);
    }
    here_ = std::move(slab);
  }

  void addPrecipitableWater(const AirLevel& below, const AirLevel& above) {
    for (std::size_t c = 0; c < precipitableWater_.size(); ++c) {
      const float ground = surface_.pressurePa.empty() ? kMissing : surface_.pressurePa[c];
      const float lower = ground < below.pressurePa[c] ? ground : below.pressurePa[c];
      const float vapour = 0.5f * (below.specificHumidity[c] + above.specificHumidity[c]);
      const float weight = vapour * (lower - above.pressurePa[c]) / 9.80665f;
      if (weight > 0) precipitableWater_[c] += weight;
    }
  }

  bool belowSurface(const AirLevel& air, std::size_t c) const {
    const bool deeper = !surface_.pressurePa.empty() && air.pressurePa[c] > surface_.pressurePa[c];
    return deeper || air.heightMeters[c] < airMaker_.groundMeters()[c];
  }

  /// Keeps the cloudy cells of the level in the middle.
  void close(const std::vector<float>& heightsAbove) {
    const Slab& here = *here_;
    keepWinds(here);
    const auto tellsCloud = [&](const auto& value) {
      return hasCondensate_ ? isCondensate(value.first) : tellsHumidCloud(value.first);
    };
    if (std::none_of(here.level.values.begin(), here.level.values.end(), tellsCloud)) return;
    for (std::size_t c = 0; c < result_.columns.size(); ++c) {
      if (!std::isfinite(here.air.temperatureK[c]) || belowSurface(here.air, c)) continue;
      auto pending = hasCondensate_ ? fromWater(here, c) : fromHumidity(here, c);
      if (!pending) continue;
      const auto borders = bordersOf(here, heightsAbove, c);
      if (!borders) continue;
      pending->cell.baseMeters = borders->base;
      pending->cell.topMeters = borders->top;
      pending_.push_back(*pending);
    }
  }

  void keepWinds(const Slab& here) {
    for (std::size_t c = 0; c < result_.columns.size(); c += windStride_) {
      const WindAloft wind{result_.columns[c], here.air.heightMeters[c],
                           within(here.value(Quantity::WindEast, c), -200, 200),
                           within(here.value(Quantity::WindNorth, c), -200, 200)};
      if (!belowSurface(here.air, c) && std::isfinite(wind.heightMeters + wind.windEast + wind.windNorth))
        result_.winds.push_back(wind);
    }
  }

  std::optional<Borders> bordersOf(const Slab& here, const std::vector<float>& heightsAbove, std::size_t c) {
    const float height = here.air.heightMeters[c];
    if (!std::isfinite(height)) return std::nullopt;
    auto borders = bordersBetween(heightsBelow_, height, heightsAbove, c);
    if (!borders) {
      borders = bordersAlone(here.air, c);
      derivations_.note(Derivation::DepthOfLoneLevel);
    }
    const float ground = airMaker_.groundMeters()[c];
    if (borders->base < ground) borders->base = ground;
    if (!hasCondensate_) cutToModelClouds(c, *borders);
    return borders->top > borders->base ? borders : std::nullopt;
  }

  /// The model's own base and top are believed where they stand above the ground and in their order.
  void cutToModelClouds(std::size_t c, Borders& borders) {
    const float known = airMaker_.groundMeters()[c];
    const float ground = std::isfinite(known) ? known : result_.states[c].surfaceHeightMeters;
    const auto believed = [&](const std::vector<float>& heights) {
      return heights.empty() || !(heights[c] >= ground) ? kMissing : heights[c];
    };
    const float base = believed(surface_.cloudBaseMeters), top = believed(surface_.cloudTopMeters);
    if (base >= top) return;
    const Borders before = borders;
    if (base > borders.base) borders.base = base;
    if (top < borders.top) borders.top = top;
    if (borders.base != before.base || borders.top != before.top)
      derivations_.note(Derivation::WaterWithinModelClouds);
  }

  /// Nothing where the cell is clear.
  std::optional<PendingCell> fromWater(const Slab& slab, std::size_t c) {
    const Water water = waterOf(slab, c);
    if (water.total() <= kCloudyMixingRatio || !std::isfinite(water.total())) return std::nullopt;
    PendingCell pending = pendingAt(slab, c);
    pending.liquid = water.liquid;
    pending.ice = water.ice;
    const double saturation = saturationSpecificHumidity(slab.air.pressurePa[c], slab.air.temperatureK[c]);
    pending.derivedFraction =
        static_cast<float>(cloudFractionXuRandall(pending.cell.relativeHumidity, water.total(), saturation));
    if (!slab.level.has(Quantity::CloudLiquid) && !slab.level.has(Quantity::CloudIce))
      derivations_.note(Derivation::PhaseFromTemperature);
    return pending;
  }

  std::optional<PendingCell> fromHumidity(const Slab& slab, std::size_t c) const {
    const float pressure = slab.air.pressurePa[c];
    if (!(pressure >= kLeastHumidCloudPa)) return std::nullopt;
    PendingCell pending = pendingAt(slab, c);
    const double critical = criticalRelativeHumidity(pressure, airMaker_.groundPressurePa()[c]);
    pending.derivedFraction =
        static_cast<float>(cloudFractionSundqvist(slab.air.relativeHumidity[c], critical));
    const bool given = std::isfinite(pending.givenFraction);
    const float fraction = given ? pending.givenFraction : pending.derivedFraction;
    return fraction < kLeastFraction ? std::nullopt : std::optional(pending);
  }

  PendingCell pendingAt(const Slab& slab, std::size_t c) const {
    const double pressure = slab.air.pressurePa[c], temperature = slab.air.temperatureK[c];
    // Cloud without a known humidity is taken as saturated air.
    const bool known = std::isfinite(slab.air.relativeHumidity[c]);
    const auto wind = [&](Quantity quantity) {
      const float value = within(slab.value(quantity, c), -200, 200);
      return std::isfinite(value) ? value : 0.0f;
    };
    PendingCell pending;
    pending.column = static_cast<std::uint32_t>(c);
    pending.airDensity = static_cast<float>(
        airDensity(pressure, temperature,
                   known ? slab.air.specificHumidity[c] : saturationSpecificHumidity(pressure, temperature)));
    pending.givenFraction = std::clamp(slab.value(Quantity::CloudFraction, c), 0.0f, 1.0f);
    pending.cell.level = slab.number;
    pending.cell.temperatureK = slab.air.temperatureK[c];
    pending.cell.relativeHumidity = known ? slab.air.relativeHumidity[c] : 1.0f;
    pending.cell.windEast = wind(Quantity::WindEast);
    pending.cell.windNorth = wind(Quantity::WindNorth);
    pending.cell.pressurePa = slab.air.pressurePa[c];
    return pending;
  }

  Surface surface_;
  Derivations& derivations_;
  AirMaker airMaker_;
  bool hasCondensate_, hasHumidity_;
  std::size_t windStride_;
  CloudColumns result_;
  std::optional<Level> next_;
  std::optional<Slab> here_;
  std::vector<float> heightsBelow_, precipitableWater_;
  std::vector<PendingCell> pending_;
  std::uint32_t levels_ = 0;
};

}  // namespace

CloudColumns collectColumns(const Source& source, const std::vector<std::uint32_t>& cells) {
  Derivations derivations;
  const LevelPlan plan = planOf(source, cells);
  Collector collector(source, cells, plan, derivations);
  GapFiller gaps(
      plan, [&](Level level) { collector.add(std::move(level)); }, derivations);
  source.visitLevels(cells, [&](const Level& level) { gaps.add(level); });
  return collector.finish();
}

}  // namespace cloudgen::field
