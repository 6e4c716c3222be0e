// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "image/preview.hpp"

namespace cloudgen::image {

/// Sky, ground, haze and the clouds' shadow on the ground.
class Backdrop {
 public:
  Backdrop(std::span<const Splat> splats, const Surroundings& surroundings);

  /// Display-encoded colour of what a ray meets beyond the clouds. `direction` is a unit vector.
  glm::vec3 colorAlong(const glm::dvec3& eye, const glm::dvec3& direction) const;
  /// Along a unit vector from the eye to the terrain's relief; infinite where it meets none (the flat ground
  /// about it hides no cloud and does not count).
  double distanceToTerrain(const glm::dvec3& eye, const glm::dvec3& direction) const;
  /// Share of a thing's own colour that reaches the eye through the haze between them.
  float clarity(const glm::dvec3& eye, const glm::dvec3& point) const;
  /// Display-encoded colour of the haze in a direction.
  glm::vec3 hazeColor(const glm::dvec3& direction) const;

 private:
  glm::vec3 groundColor(const glm::dvec3& point, double distance) const;
  glm::vec3 skyColor(const glm::dvec3& direction) const;
  float shadowAt(double x, double z) const;

  Surroundings surroundings_;
  double summit_ = 0;
  double originX_ = 0, originZ_ = 0, cell_ = 1;
  int side_ = 0;
  std::vector<float> shadowDepth_;
};

}  // namespace cloudgen::image
