// SPDX-License-Identifier: Apache-2.0
#include "field/column_state.hpp"

#include <cmath>
#include <limits>

namespace cloudgen::field {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// The value at `share` of the way; an end that has no weight may be missing.
float between(float low, float high, double share) {
  if (share <= 0) return low;
  if (share >= 1) return high;
  return static_cast<float>(low + share * (high - low));
}

}  // namespace

void fillStandardLevels(const AirLevel& below, const AirLevel& above, std::vector<ColumnState>& states) {
  struct Standard {
    double pressurePa;
    float ColumnState::*temperature;
    float ColumnState::*dewPoint;
  };
  static constexpr std::array<Standard, 3> kStandards{
      {{85000, &ColumnState::temperature850K, &ColumnState::dewPoint850K},
       {70000, &ColumnState::temperature700K, &ColumnState::dewPoint700K},
       {50000, &ColumnState::temperature500K, nullptr}}};
  for (std::size_t c = 0; c < states.size(); ++c) {
    const double low = below.pressurePa[c], high = above.pressurePa[c];
    if (!(low > high) || !(high > 0)) continue;
    for (const Standard& standard : kStandards) {
      if (standard.pressurePa > low || standard.pressurePa < high) continue;
      const double share = std::log(low / standard.pressurePa) / std::log(low / high);
      states[c].*standard.temperature = between(below.temperatureK[c], above.temperatureK[c], share);
      if (standard.dewPoint)
        states[c].*standard.dewPoint = between(below.dewPointK[c], above.dewPointK[c], share);
    }
  }
}

float kIndex(const ColumnState& state) {
  return (state.temperature850K - state.temperature500K) + (state.dewPoint850K - 273.15f) -
         (state.temperature700K - state.dewPoint700K);
}

ColumnState unknownState() { return {kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing}; }

}  // namespace cloudgen::field
