// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "base/time.hpp"
#include "light/sky.hpp"

namespace cloudgen::light {

/// The moon as the scene sees it. Azimuth clockwise from north.
struct Moon {
  double azimuthDegrees = 0, elevationDegrees = -90;
  double phaseAngleDegrees = 180;  ///< between sun and Earth, seen from the moon: 0 full, 180 new
  glm::vec3 direction{0, -1, 0};   ///< towards the moon, scene frame
};

/// Where the moon stands over a place on the ground (libnova: ELP 2000-82B), refraction not included.
Moon moonAt(base::UtcTime time, double longitudeDegrees, double latitudeDegrees);

/// Share of the moon's disc that is lit.
double litShare(const Moon& moon);

/// Illuminance of a surface that faces the moon at its mean distance, outside of the air (Krisciunas & Schaefer 1991,
/// "A model of the brightness of moonlight"): 0.31 lux at full moon, a tenth of it at half.
double moonIlluminanceLux(double phaseAngleDegrees);

/// How bright a night is shown, of one under a half moon at the zenith: by the moonlight that comes
/// down on level ground and the light of stars and air, 0.001 lux; as sensation goes, by the cube root (Stevens).
float moonlightUnder(const Moon& moon);

/// Light from one direction on clouds at a height, display-linear.
struct KeyLight {
  glm::vec3 direction{0, 1, 0};
  glm::vec3 color{1};
};

/// That of the sun or, once it gives less, that of the moon.
KeyLight keyLight(const Sun& sun, const Moon& moon, double heightMeters);

}  // namespace cloudgen::light
