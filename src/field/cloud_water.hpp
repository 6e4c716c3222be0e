// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::field {

/// A cell is cloudy where its condensate exceeds this mixing ratio (kg/kg; GSI's threshold).
inline constexpr float kCloudyMixingRatio = 1e-6f;

/// Density of moist air, kg/m3, from p = rho R_d T_v.
double airDensity(double pressurePa, double temperatureK, double specificHumidity);

/// Saturation vapour pressure, Pa, over water above 0 C, over ice below -23 C, mixed between
/// (Buck 1981; mixing as in the IFS documentation, part IV).
double saturationVapourPressure(double temperatureK);

/// Dew point over water, K, from relative humidity (0..1), by Buck 1981.
double dewPoint(double temperatureK, double relativeHumidity);

/// Saturation specific humidity over water above 0 C, over ice below -23 C, mixed between
/// (Buck 1981 vapour pressures; mixing as in the IFS documentation, part IV).
double saturationSpecificHumidity(double pressurePa, double temperatureK);

/// Share of condensate that is liquid: 1 at and above 0 C, 0 at and below -23 C, ((T-250.16)/23)^2 between
/// (IFS documentation, part IV: the diagnostic mixed phase).
double liquidShare(double temperatureK);

/// Cloud fraction from relative humidity (0..1) and condensate: Xu & Randall 1996, as WRF uses it
/// (exponent clamped at -6.9, fractions under 0.01 cut to 0).
double cloudFractionXuRandall(double relativeHumidity, double condensate, double saturationHumidity);

/// Relative humidity (0..1) above which a cell has cloud: 0.7 + 0.2 exp(1 - (ps / p)^4), from 0.9 at the
/// ground to 0.7 aloft (Lohmann & Roeckner 1996, with the numbers of ECHAM5 in Quaas 2012).
double criticalRelativeHumidity(double pressurePa, double surfacePressurePa);

/// Cloud fraction from relative humidity alone: 1 - sqrt((1 - RH) / (1 - RH_crit)) (Sundqvist et al. 1989).
double cloudFractionSundqvist(double relativeHumidity, double criticalHumidity);

/// Water content within clouds, kg/m3, where only humidity is known: 0.21 g/m3 exp(-z / h) with h = 700 m
/// ln(1 + W), W the precipitable water in kg/m2 (Hack 1998; NCAR CCM3, Kiehl et al. 1996).
double diagnosedCloudWater(double heightAboveGroundMeters, double precipitableWater);

/// Effective radius of droplets, m: Martin et al. 1994 for a number of 1e8 m-3 and k = 0.77, within 4..30 um.
double liquidEffectiveRadius(double liquidWaterContent);

/// Effective radius of ice, m: Sun & Rikus 1999 with Sun 2001, r_e = 3 sqrt(3) D_e / 8; the content is held
/// within 1e-4..0.3 g/m3 and the temperature within -70..-5 C, where the fit holds.
double iceEffectiveRadius(double iceWaterContent, double temperatureK);

/// Extinction per metre of water content (kg/m3): 3 W / (2 rho r_e), geometric optics, Q_ext = 2.
double liquidExtinction(double liquidWaterContent);
double iceExtinction(double iceWaterContent, double temperatureK);

/// Height above mean sea level, m, of a geopotential height (gpm): Mahoney 2001, with the gravity and radius
/// of the WGS84 ellipsoid at that latitude.
double geometricHeight(double geopotentialMeters, double latitudeDegrees);

/// The way back: geopotential height, gpm, of a height above mean sea level.
double geopotentialHeight(double heightMeters, double latitudeDegrees);

}  // namespace cloudgen::field
