// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::field {

/// The share of the optical depth that lies below a layer's lower height, and above its upper one.
inline constexpr float kBorderShare = 0.05f;

/// A cloud layer over one model cell: what steps 2 and 3 find. Winds in m/s, heights in metres above mean sea
/// level. NaN is what the source does not tell.
struct Layer {
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  std::uint32_t cell = 0;     ///< grid index of the model cell
  std::uint32_t patch = 0;    ///< layers that touch sideways and overlap in height share a patch
  std::uint16_t ordinal = 0;  ///< counted upwards within the cell; part of every random address
  float baseMeters = 0, topMeters = 0, surfaceMeters = 0;
  /// Where kBorderShare of its optical depth lies below, and above: within base and top, and well within them
  /// where the water gathers in the middle.
  float lowerMeters = 0, upperMeters = 0;
  float middleMeters = 0;                             ///< half of its optical depth lies below
  float fraction = 0;                                 ///< cover seen from above, 0..1
  float liquidOpticalDepth = 0, iceOpticalDepth = 0;  ///< vertical, in cloud
  float baseTemperatureK = kUnknown, topTemperatureK = kUnknown, topPressurePa = 0;
  float kIndexC = kUnknown;
  float windEast = 0, windNorth = 0;    ///< mean over the layer
  float shearEast = 0, shearNorth = 0;  ///< top minus base
  int cloudCount = 0;                   ///< where the source counts its clouds (weather codes); 0: by cover
  float spacingMeters = 0;              ///< least distance between those clouds
  base::Genus genus{};
  std::string_view rule;  ///< id of the rule that decided the genus (typeRules()); empty: not decided

  /// Base and top, the optical depth spread evenly between them.
  void spreadEvenly(float base, float top) {
    baseMeters = base, topMeters = top;
    lowerMeters = base + kBorderShare * (top - base), upperMeters = top - kBorderShare * (top - base);
    middleMeters = 0.5f * (base + top);
  }
  float depthMeters() const { return topMeters - baseMeters; }
  float opticalDepth() const { return liquidOpticalDepth + iceOpticalDepth; }
};

/// How many metres of height two layers share; below 0, how far apart they are.
inline float overlapMeters(const Layer& a, const Layer& b) {
  return std::min(a.topMeters, b.topMeters) - std::max(a.baseMeters, b.baseMeters);
}

/// A cloud to be made: what steps 4 and 5 decide.
struct Cloud {
  std::uint32_t layer = 0;    ///< index in CloudTable::layers
  std::uint32_t ordinal = 0;  ///< counted within the layer; part of every random address
  double longitudeDegrees = 0, latitudeDegrees = 0;
  float widthMeters = 0, baseMeters = 0, depthMeters = 0;
  float opticalDepth = 0;  ///< vertical, mean over the footprint
};

/// Steps 1 to 5 fill it column by column; production reads it.
struct CloudTable {
  std::vector<Layer> layers;
  std::vector<Cloud> clouds;
};

}  // namespace cloudgen::field
