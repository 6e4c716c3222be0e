// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "input/cdfs/analysis.hpp"

namespace cloudgen::input::cdfs {

/// Low cloud has its base below the first, high cloud above the second (LISF process_cloud_layers).
inline constexpr float kMiddleFromMeters = 2000, kHighAboveMeters = 6000;
/// Ages up to which low cloud, and middle and high cloud, still count (LISF AGRMET_loadcloud); neither may be
/// observed more than kEarliestMinutes after the base time.
inline constexpr int kLowMinutes = 180, kUpperMinutes = 360, kEarliestMinutes = -180;
/// Top above which a cumulonimbus is one, by latitude (degrees): 12.6 km below 10, 12.3 below 25, 12.0 below
/// 42.5, 11.7 below 60, 11.4 km beyond (LISF compute_type_based_clouds, AGRMET_bndslc).
float leastCumulonimbusTop(double latitudeDegrees);

/// Drops what does not count, by setting its amount to 0: cells beyond the equator of their half (of a pair),
/// layers that are too old or were never observed, amounts over 100 % and layers without a height; takes low
/// cumulonimbus as cumulus; compares the total cover. Everything done is counted in a warning.
void applyRules(Analysis& analysis);

}  // namespace cloudgen::input::cdfs
