// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::field {

/// The ICAO standard atmosphere (Doc 7488, 1993) up to 47 km, its top layer drawn on above. Heights are
/// geopotential (gpm), pressures Pa.
double standardTemperature(double geopotentialMeters);
double standardPressure(double geopotentialMeters);
/// Where the standard atmosphere has this pressure; NaN for pressures that are not positive.
double standardHeight(double pressurePa);

/// Its lapse rate in the troposphere, K/gpm.
inline constexpr double kStandardLapseRate = 0.0065;

}  // namespace cloudgen::field
