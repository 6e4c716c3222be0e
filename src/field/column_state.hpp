// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "field/air.hpp"
#include "field/cloud_columns.hpp"

namespace cloudgen::field {

/// Fills temperatures and dew points at 850, 700 and 500 hPa from two levels (the lower first) that enclose
/// them, linearly in the logarithm of pressure; leaves what they do not enclose.
void fillStandardLevels(const AirLevel& below, const AirLevel& above, std::vector<ColumnState>& states);

/// K-index in C (George 1960): (T850 - T500) + Td850 - (T700 - Td700); NaN where one of them is.
float kIndex(const ColumnState& state);

/// A state with everything missing (NaN).
ColumnState unknownState();

}  // namespace cloudgen::field
