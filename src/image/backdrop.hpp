// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "image/atmosphere.hpp"
#include "image/preview.hpp"
#include "image/volume.hpp"

namespace cloudgen::image {

/// Sky, ground, haze and the clouds' shadow on the ground.
class Backdrop {
 public:
  /// The sky is the one over `eye`.
  Backdrop(std::span<const Splat> splats, const Surroundings& surroundings, const glm::dvec3& eye);

  /// Display-linear colour of what a ray meets beyond the clouds, without the sun's disc. `direction` is a
  /// unit vector.
  glm::vec3 radianceAlong(const glm::dvec3& eye, const glm::dvec3& direction) const;
  /// The sun's disc, aureole and halo, display-linear, as clouds of these optical depths let them through.
  glm::vec3 sunlightThrough(const glm::dvec3& direction, float water, float ice) const;
  /// Along a unit vector from the eye to the terrain's relief; infinite where it meets none (the flat ground
  /// about it hides no cloud and does not count).
  double distanceToTerrain(const glm::dvec3& eye, const glm::dvec3& direction) const;
  /// The haze before what lies in a direction.
  Haze hazeAlong(const glm::dvec3& eye, const glm::dvec3& direction) const;

 private:
  glm::vec3 groundColor(const glm::dvec3& point, double distance) const;
  float shadowAt(double x, double z) const;

  Surroundings surroundings_;
  Atmosphere atmosphere_;
  double summit_ = 0;
  double originX_ = 0, originZ_ = 0, cell_ = 1;
  int side_ = 0;
  std::vector<float> shadowDepth_;
};

}  // namespace cloudgen::image
