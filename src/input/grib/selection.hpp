// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/grib/field_header.hpp"

namespace cloudgen::input::grib {

/// The fields of one time, member and grid, by level and meaning.
struct Selection {
  base::UtcTime run, valid;
  /// From the ground upwards: highest pressure first.
  std::map<double, std::map<field::Quantity, FieldHeader>, std::greater<>> levels;
  std::optional<FieldHeader> surfacePressure, surfaceHeight;
  std::vector<std::string> warnings;

  bool has(field::Quantity quantity) const;
  /// Any field of cloud water: the one that decides time and grid.
  const FieldHeader& cloudWater() const;
};

/// Chooses among all fields of the files. Throws InputError when there is no cloud water on pressure levels.
Selection select(const std::vector<FieldHeader>& headers, const std::string& where);

/// "cloud condensate: clwmr on 21 levels, 1000 to 100 hPa": one line a quantity.
std::vector<std::string> fieldLines(const Selection& selection);

/// What is not in the files and how it will be made, one line each.
std::vector<std::string> missingLines(const Selection& selection);

}  // namespace cloudgen::input::grib
