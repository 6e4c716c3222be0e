// SPDX-License-Identifier: Apache-2.0
#include "field/level_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cloudgen::field {
namespace {

constexpr std::array kAlways{Quantity::CloudCondensate,  Quantity::CloudLiquid, Quantity::CloudIce,
                             Quantity::CloudFraction,    Quantity::Temperature, Quantity::RelativeHumidity,
                             Quantity::SpecificHumidity, Quantity::WindEast,    Quantity::WindNorth};
constexpr std::array kHeights{Quantity::Height, Quantity::GeopotentialHeight, Quantity::HeightAboveGround};

double valueOr(const Level& level, Quantity quantity, std::size_t cell, double otherwise) {
  const auto found = level.values.find(quantity);
  return found == level.values.end() ? otherwise : found->second[cell];
}

/// Logarithm of pressure; NaN where the level does not say it.
double logPressure(const Level& level, std::size_t cell) {
  const double pressure = valueOr(level, Quantity::Pressure, cell, level.pressurePa);
  return pressure > 0 ? std::log(pressure) : std::numeric_limits<double>::quiet_NaN();
}

/// How far the middle level lies from the lower to the upper one.
double shareOfWay(const std::array<const Level*, 3>& levels, std::size_t cell, double byCount) {
  const auto share = [&](const auto& coordinate) {
    const double low = coordinate(*levels[0]), middle = coordinate(*levels[1]), high = coordinate(*levels[2]);
    return (middle - low) / (high - low);
  };
  double found = share([&](const Level& level) { return logPressure(level, cell); });
  for (const Quantity height : kHeights)
    if (!std::isfinite(found))
      found = share([&](const Level& level) {
        return valueOr(level, height, cell, std::numeric_limits<double>::quiet_NaN());
      });
  return found >= 0 && found <= 1 ? found : byCount;
}

/// The level with this quantity and what tells its height only.
Level onlyWith(const Level& level, Quantity quantity) {
  Level kept{level.pressurePa, {}};
  for (const Quantity needed : {quantity, Quantity::Pressure, Quantity::Height, Quantity::GeopotentialHeight,
                                Quantity::HeightAboveGround})
    if (const auto found = level.values.find(needed); found != level.values.end()) kept.values.insert(*found);
  return kept;
}

}  // namespace

bool LevelPlan::has(Quantity quantity) const {
  return std::any_of(levels.begin(), levels.end(),
                     [&](const auto& level) { return level.contains(quantity); });
}

std::size_t LevelPlan::nextWith(Quantity quantity, std::size_t level) const {
  for (++level; level < levels.size(); ++level)
    if (levels[level].contains(quantity)) return level;
  return levels.size();
}

LevelPlan planOf(const Source& source, std::span<const std::uint32_t> cells) {
  LevelPlan plan;
  const auto note = [&](const Level& level) {
    auto& quantities = plan.levels.emplace_back();
    for (const auto& [quantity, values] : level.values) quantities.insert(quantity);
  };
  source.visitLevels({}, note);
  if (plan.levels.empty() && !cells.empty()) source.visitLevels(cells.first(1), note);
  return plan;
}

GapFiller::GapFiller(LevelPlan plan, std::function<void(Level)> next, Derivations& derivations)
    : plan_(std::move(plan)), next_(std::move(next)), derivations_(derivations) {
  const auto consider = [&](Quantity quantity) {
    for (std::size_t level = 0; level < plan_.levels.size(); ++level)
      if (isGap(quantity, level)) {
        fillable_.push_back(quantity);
        return;
      }
  };
  for (const Quantity quantity : kAlways) consider(quantity);
  if (!plan_.has(Quantity::Temperature))
    for (const Quantity quantity : kHeights) consider(quantity);
}

bool GapFiller::isGap(Quantity quantity, std::size_t level) const {
  const auto& levels = plan_.levels;
  if (level >= levels.size() || levels[level].contains(quantity)) return false;
  const bool below = std::any_of(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(level),
                                 [&](const auto& other) { return other.contains(quantity); });
  return below && plan_.nextWith(quantity, level) < levels.size();
}

bool GapFiller::complete(std::size_t level) const {
  return std::all_of(fillable_.begin(), fillable_.end(), [&](Quantity quantity) {
    return !isGap(quantity, level) || plan_.nextWith(quantity, level) < given_ + waiting_.size();
  });
}

void GapFiller::add(const Level& level) {
  waiting_.push_back(level);
  while (!waiting_.empty() && complete(given_)) giveOn();
}

void GapFiller::giveOn() {
  Level level = std::move(waiting_.front());
  for (const Quantity quantity : fillable_)
    if (level.has(quantity)) last_[quantity] = {given_, onlyWith(level, quantity)};
  // Heights first: they may serve as coordinate for the rest.
  for (auto quantity = fillable_.rbegin(); quantity != fillable_.rend(); ++quantity)
    if (isGap(*quantity, given_)) fill(level, *quantity);
  waiting_.pop_front();
  ++given_;
  next_(std::move(level));
}

void GapFiller::fill(Level& level, Quantity quantity) const {
  const std::size_t above = plan_.nextWith(quantity, given_);
  const auto& [below, lower] = last_.at(quantity);
  const Level& upper = waiting_[above - given_];
  const double byCount = static_cast<double>(given_ - below) / static_cast<double>(above - below);
  const auto from = lower.of(quantity), to = upper.of(quantity);
  std::vector<float> values(from.size());
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    const double share = shareOfWay({&lower, &level, &upper}, cell, byCount);
    values[cell] = static_cast<float>((1 - share) * from[cell] + share * to[cell]);
  }
  derivations_.noteInterpolated(quantity);
  level.values.emplace(quantity, std::move(values));
}

}  // namespace cloudgen::field
