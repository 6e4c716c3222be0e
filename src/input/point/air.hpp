// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/genus.hpp"
#include "field/source.hpp"

namespace cloudgen::input {

/// What a point report tells of the air over its place, and what follows from it for the heights of clouds
/// that the report leaves open.
struct Air {
  double latitudeDegrees = 0;
  double surfaceMeters = 0;                   ///< above mean sea level
  double temperatureC = 15;                   ///< at the surface
  double windFromDegrees = 0, windSpeed = 0;  ///< at 10 m, m/s; the direction it comes from
};

/// Dew point from temperature and relative humidity (0..1): Magnus formula with the coefficients of Alduchov
/// & Eskridge 1996.
double dewPointC(double temperatureC, double relativeHumidity);

/// Height above ground at which surface air condenses: 125 m a degree of dew-point spread (Espy; Lawrence
/// 2005, BAMS 86, 225), within 60 and 4000 m.
double condensationMeters(double temperatureC, double dewPointC);

/// Height above mean sea level at which the air is that cold: 6.5 K a kilometre from the surface upwards (the
/// lapse of the standard atmosphere).
double heightOfMeters(const Air& air, double temperatureC);

/// Lower borders of the middle and the high etage, metres above ground (WMO atlas, polar to tropical values).
inline constexpr double kMiddleEtageMeters = 2000;
double highEtageMeters(double latitudeDegrees);
/// Height of the tropopause above mean sea level: 9 km at the poles, 16.5 km at the equator.
double tropopauseMeters(double latitudeDegrees);

/// Top of a storm: where the air has -50 C, under the tropopause, at least 4 km above the base.
double stormTopMeters(const Air& air, double baseMeters);

/// A layer between two heights above mean sea level. Optical depth: depth times the genus's usual extinction
/// (its usual optical depth over its usual depth, as in templates/types). Ice: none down to 0 C at mid layer,
/// all from -23 C. Wind: that of 10 m by the power law with exponent 1/7 (Hellmann; Justus & Mikhail 1976) at
/// mid layer; shear: top minus base.
field::StatedLayer layerOf(const Air& air, base::Genus genus, double cover, double baseMeters,
                           double topMeters);

/// Elevation of the sun's centre in degrees, to about a degree: declination by Cooper 1969, mean solar time.
/// Only for telling day from night.
double sunElevationDegrees(base::UtcTime time, const field::GeoPoint& place);

}  // namespace cloudgen::input
