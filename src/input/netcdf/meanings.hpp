// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "input/model/model_field.hpp"
#include "input/netcdf/file.hpp"
#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {

/// What is done to the values of a variable after their unit is SI.
enum class Treatment {
  None,
  DividedByGravity,     ///< geopotential, m2 s-2, becomes height in gpm
  PerDryAir,            ///< water per kg of dry air; becomes per kg of moist air where the vapour is known
  VapourPerDryAir,      ///< a mixing ratio of vapour r becomes r / (1 + r)
  PotentialTemperature  ///< becomes temperature by the pressure
};

/// What a variable is, found by standard_name, then by the attributes that cfgrib leaves, then by its name.
struct Meaning {
  std::variant<field::Quantity, model::Single> what;
  Treatment treatment = Treatment::None;
  bool alongGridAxes = false;
  bool inPercent = false;
  Conversion toSi;                 ///< from the unit of the file; fractions in per cent stay so
  std::string warningId, warning;  ///< about the unit; empty: none
};

/// A variable with a vertical dimension (`onLevels`) means something else than one without. Nothing if
/// cloudgen has no use for it.
std::optional<Meaning> meaningOf(const Variable& variable, bool onLevels);

/// "rain", "snow", "graupel", ...: what is known but not used; empty for all else.
std::string unusedMeaning(const Variable& variable);

}  // namespace cloudgen::input::netcdf
