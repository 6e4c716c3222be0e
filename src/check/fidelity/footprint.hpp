// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cloudgen::check {

/// A soft blob of a written scene as one sees it from straight above: what it adds to the optical depth of a
/// vertical ray, and at which height. Lengths in metres of the scene frame (x east, z south, y up).
struct Footprint {
  glm::vec2 place{0};         ///< x and z of the centre
  glm::mat2 toDeviations{1};  ///< from metres off the centre to standard deviations
  float opticalDepth = 0;     ///< of the ray through the centre
  float reach = 4;            ///< deviations beyond which it adds nothing
  bool square = false;        ///< cut off along two axes, as a card is, and not all around
  float height = 0;           ///< mean height of what a ray through the centre meets
  glm::vec2 heightSlope{0};   ///< metres up for a metre in x and in z
  float heightDeviation = 0;  ///< standard deviation of height along a ray

  /// Half the sides of the box around what it covers.
  glm::vec2 halfSides() const;
};

/// A Gaussian blob with half-axes of one standard deviation (columns) whose optical depth along the shortest
/// of them is `frontalOpticalDepth`: its exact integrals along vertical rays. They are followed out to four
/// deviations, or to where they fall below 0.001.
Footprint footprintOfBlob(const glm::vec3& center, const glm::mat3& halfAxes, float frontalOpticalDepth);

/// A flat card with a Gaussian sprite: half-axes of one standard deviation, its border `reach` of them away.
/// Drawn with one optical depth from wherever it is seen.
Footprint footprintOfCard(const glm::vec3& center, const std::array<glm::vec3, 2>& halfAxes, float reach,
                          float opticalDepth);

/// True if a card or blob is seen from above at all: not edge-on, and every number finite.
bool isSeen(const Footprint& footprint);

}  // namespace cloudgen::check
