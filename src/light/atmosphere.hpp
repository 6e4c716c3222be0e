// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace cloudgen::light {

/// Clear air at 680, 550 and 440 nm (red, green, blue): Rayleigh scattering with a scale height of 8 km, a
/// thin aerosol of 1.2 km (optical depth 0.024), and ozone in a layer about 25 km, around a spherical Earth
/// (model of Bruneton & Neyret 2008; coefficients of air and ozone as in Bruneton 2017, "Precomputed
/// Atmospheric Scattering: a New Implementation", and Hillaire 2020).

/// Share of the sunlight that comes to a height above the ground from an elevation -90..90 degrees; 0 where
/// the Earth is in between. Refraction is left out.
glm::vec3 sunTransmittance(double elevationDegrees, double heightMeters);

/// Radiance of the clear sky on the ground, per steradian and sunlight of 1 outside, by single scattering.
/// Azimuth counts from the sun.
glm::vec3 skyRadiance(double elevationDegrees, double azimuthFromSunDegrees, double sunElevationDegrees);

}  // namespace cloudgen::light
