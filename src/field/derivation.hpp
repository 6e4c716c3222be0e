// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "field/source.hpp"

namespace cloudgen::field {

/// What was not in the input, and how it was made; in the order of reports.
enum class Derivation {
  GroundFromSurfacePressure,
  GroundAtSeaLevel,
  HeightFromHeightAboveGround,
  HeightFromSurface,
  HeightFromSeaLevel,
  HeightFromStandardAtmosphere,
  PressureFromHeight,
  PressureFromStandardAtmosphere,
  TemperatureFromThickness,
  TemperatureFromStandardAtmosphere,
  HumidityFromSpecificHumidity,
  FractionFromHumidityAndWater,
  FractionNotAllZero,
  FractionFromHumidity,
  FractionFull,
  WaterFromHumidity,
  WaterWithinModelClouds,
  PhaseFromTemperature,
  DepthOfLoneLevel,
};

/// Collects what was derived.
class Derivations {
 public:
  void note(Derivation derivation) { noted_.set(static_cast<std::size_t>(derivation)); }
  void noteInterpolated(Quantity quantity) { interpolated_.insert(quantity); }

  /// (what, how), one line each.
  std::vector<std::pair<std::string, std::string>> lines() const;

 private:
  static constexpr std::size_t kCount = static_cast<std::size_t>(Derivation::DepthOfLoneLevel) + 1;
  std::bitset<kCount> noted_;
  std::set<Quantity> interpolated_;
};

}  // namespace cloudgen::field
