// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "base/time.hpp"

namespace cloudgen::light {

/// The sun as the scene sees it. Azimuth clockwise from north.
struct Sun {
  double azimuthDegrees = 180, elevationDegrees = 45;
  glm::vec3 direction{0, 1, 0};  ///< towards the sun, scene frame (x east, y up, z south)
  glm::vec3 color{1};            ///< display-linear, reddened by the air, 0 once it is set for low clouds
};

/// Colours of the clear sky and the ground, display-linear.
struct Sky {
  glm::vec3 zenith{0}, horizon{0}, ground{0};
  glm::vec3 ambient{0};  ///< mean sky light on a cloud from above
  glm::vec3 bounce{0};   ///< light from the ground on a cloud from below
  float moonlight = 1;   ///< as skyUnder was told
};

/// Colour of the sun at a height above the ground: the higher, the later it sets.
glm::vec3 sunColorAt(double elevationDegrees, double heightMeters);

/// Where the sun stands (libnova: Meeus, Astronomical Algorithms), refraction not included.
Sun sunAt(base::UtcTime time, double longitudeDegrees, double latitudeDegrees);

/// A sun at a chosen place in the sky. Azimuth clockwise from north, elevation -90..90.
Sun sunFrom(double azimuthDegrees, double elevationDegrees);

/// The clear sky that goes with a sun, by single scattering in its colours and contrast
/// (light/atmosphere.hpp): blue by day, red at the horizon when the sun is low, and after dusk as bright as the moon
/// makes it (moonlightUnder; 1 is a half moon at the zenith). Its brightness is that of an eye that gets used to dusk.
Sky skyUnder(const Sun& sun, float moonlight = 1);

}  // namespace cloudgen::light
