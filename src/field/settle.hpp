// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "field/cloud_columns.hpp"
#include "field/derivation.hpp"

namespace cloudgen::field {

/// A cloudy cell before its fraction is settled; water as grid mean, kg/kg.
struct PendingCell {
  std::uint32_t column = 0;
  CloudCell cell;
  float liquid = 0, ice = 0, airDensity = 0;
  float givenFraction = std::numeric_limits<float>::quiet_NaN(), derivedFraction = 0;
};

/// Settles fraction and in-cloud extinction of the cells of models with condensate, and puts them into the
/// columns in their order. The derived fraction is taken where none is given, and everywhere where the given
/// one is zero in all of them; it is 1 in all where no humidity is known.
void settleGivenWater(std::vector<PendingCell> cells, bool humidityKnown, CloudColumns& columns,
                      Derivations& derivations);

/// The same for models that tell humidity only: the water is diagnosed from the height above ground and the
/// precipitable water of the columns (kg/m2; 0 where no humidity is known: the mean of the globe is taken).
void settleDiagnosedWater(std::vector<PendingCell> cells, const std::vector<float>& precipitableWater,
                          CloudColumns& columns, Derivations& derivations);

}  // namespace cloudgen::field
