// SPDX-License-Identifier: Apache-2.0
#pragma once

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
struct Derivations {
  std::set<Derivation> used;
  std::set<Quantity> interpolated;  ///< missing on a level, there below and above

  /// (what, how), one line each.
  std::vector<std::pair<std::string, std::string>> lines() const;
};

}  // namespace cloudgen::field
