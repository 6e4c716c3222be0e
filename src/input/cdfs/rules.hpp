// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "input/cdfs/analysis.hpp"

namespace cloudgen::input::cdfs {

/// Low cloud has its base below the first, high cloud above the second (LISF process_cloud_layers).
inline constexpr float kMiddleFromMeters = 2000, kHighAboveMeters = 6000;
/// Ages up to which low cloud, and middle and high cloud, still count (LISF AGRMET_loadcloud); neither may be
/// observed more than kEarliestMinutes after the base time.
inline constexpr int kLowMinutes = 180, kUpperMinutes = 360, kEarliestMinutes = -180;
/// Heights above this one are damage.
inline constexpr float kHighestMeters = 25000;

/// A layer as it will be told: kind, heights in metres above mean sea level, optical depth.
struct PlacedLayer {
  const CloudKind* kind = nullptr;
  float baseMeters = 0, topMeters = 0, opticalDepth = 0;
  bool baseAssumed = false, depthAssumed = false;
};

/// The layer in `slot` (cell * kLayers + layer). Where a base is missing it is the top minus the depth of its
/// type, but not under the type's least base, nor under half the top; a missing top is the base plus that
/// depth. Nothing where neither is there.
std::optional<PlacedLayer> placedLayer(const Analysis& analysis, std::size_t slot);

/// Top above which a cumulonimbus is one, by latitude (degrees): 12.6 km below 10, 12.3 below 25, 12.0 below
/// 42.5, 11.7 below 60, 11.4 km beyond (LISF compute_type_based_clouds, AGRMET_bndslc).
float leastCumulonimbusTop(double latitudeDegrees);

/// Drops what does not count, by setting its amount to 0: cells beyond the equator of their half (of a pair),
/// layers that are too old or were never observed, amounts over 100 % and layers without a height; takes low
/// cumulonimbus as cumulus; compares the total cover. Everything done is counted in a warning.
void applyRules(Analysis& analysis);

}  // namespace cloudgen::input::cdfs
