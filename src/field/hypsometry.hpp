// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::field {

/// R_d / g: gpm that a layer is thick by Kelvin of its mean virtual temperature and by e-fold of pressure.
inline constexpr double kMetersPerKelvin = 287.0597 / 9.80665;

/// Virtual temperature, K: T (1 + 0.61 q). A humidity that is unknown (NaN) counts as dry.
double virtualTemperature(double temperatureK, double specificHumidity);

/// The temperature that has this virtual temperature.
double temperatureFromVirtual(double virtualTemperatureK, double specificHumidity);

/// The hypsometric equation (Wallace & Hobbs 2006, eq. 3.29): geopotential thickness, gpm, of the air between
/// two pressures, R_d T_v / g ln(lower / upper).
double thickness(double lowerPa, double upperPa, double meanVirtualTemperatureK);

/// The same for the pressure `rise` gpm above (below where negative) one that is known.
double pressureAfter(double pressurePa, double rise, double meanVirtualTemperatureK);

/// The same for the mean virtual temperature, K, of the air between two pressures that lie `rise` gpm apart.
double meanVirtualTemperature(double lowerPa, double upperPa, double rise);

/// The same from the ground, whose temperature is not known: between the ground and a level the virtual
/// temperature falls by 6.5 K/km (ICAO). `virtualTemperatureK` is that of the level, which may lie below the
/// ground.
double thicknessFromGround(double groundPa, double levelPa, double virtualTemperatureK);
double pressureFromGround(double groundPa, double rise, double virtualTemperatureK);

}  // namespace cloudgen::field
