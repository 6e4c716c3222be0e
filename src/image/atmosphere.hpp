// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "light/sky.hpp"

namespace cloudgen::image {

/// The clear sky by single scattering on air (Rayleigh) and aerosol (Mie) with an allowance for higher
/// orders, through a flat atmosphere that thins exponentially (Nishita et al. 1993, "Display of the Earth
/// taking into account atmospheric scattering"). Display-linear, exposed as the clouds are: a white face
/// square to the sun is just white.
class Atmosphere {
 public:
  Atmosphere(const light::Sun& sun, const light::Sky& sky, double eyeHeightMeters);

  /// Radiance of the clear sky in a direction (a unit vector), without the sun's disc; below the horizon as
  /// at it.
  glm::vec3 sky(const glm::dvec3& direction) const;
  /// What a white face square to the sun would show: the unit of the sun's disc and halo.
  const glm::vec3& sunlight() const { return sunlight_; }

 private:
  glm::vec3 computed(double sineOfElevation, double azimuthFromSun) const;

  double eyeHeight_ = 0, sunElevationDegrees_ = 45;
  glm::dvec2 sunAzimuth_{0, 1};
  glm::vec3 sunlight_{1};
  float gain_ = 1;
  std::vector<glm::vec3> table_;
};

}  // namespace cloudgen::image
