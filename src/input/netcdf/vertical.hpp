// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "field/source.hpp"
#include "input/model/model_field.hpp"
#include "input/netcdf/axes.hpp"

namespace cloudgen::input::netcdf {

/// The levels of a variable, in the order of the file.
struct Levels {
  std::vector<model::Vertical> levels;
  /// Height above sea = heightA + heightB * orography, m, where the file gives it so; else empty.
  std::vector<double> heightA, heightB;
  std::string orography, surfacePressure;  ///< variables that the formula names, or empty
};

/// The levels along a vertical dimension, by its coordinate: pressure, height, or a parametric coordinate of
/// CF appendix D with its formula_terms; numbers where nothing better is said.
Levels levelsAlong(const File& file, const Axes& axes, std::size_t dimension,
                   std::vector<field::Warning>& warnings);

/// The level of a variable without vertical dimension, by a scalar coordinate that it names; empty if none.
Levels scalarLevel(const File& file, const Variable& variable, std::vector<field::Warning>& warnings);

}  // namespace cloudgen::input::netcdf
