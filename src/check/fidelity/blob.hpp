// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace cloudgen::check {

enum class BlobKind : std::uint8_t {
  Volume,  ///< a Gaussian in space: rays meet its exact integrals
  Card,    ///< a flat rectangle with a sprite, of one optical depth from wherever it is seen
  Turning  ///< a card that turns with others about a pivot to face the viewer
};

/// A soft blob of a written scene. Lengths in metres of the scene frame (x east, y up, z south).
struct Blob {
  /// Of a turning card: where it is from its pivot, (right, up, towards the viewer).
  glm::vec3 center{0};
  /// Of a volume its covariance: xx, xy, xz, yy, yz, zz. Of a card its half-axes, one standard deviation of
  /// the sprite long: right, then up; they look along right x up.
  std::array<float, 6> shape{};
  /// Of a volume its extinction integrated over space, m2; of a card the optical depth of its centre.
  float strength = 0;
  float opacity = 0;  ///< of its centre, as viewers blend it
  /// Of a card: deviations of what it stands for, to those of its sprite. Its extinction is the same.
  float narrowing = 1;
  std::uint32_t pivot = 0;  ///< of a turning card: index among the scene's pivots
  BlobKind kind = BlobKind::Volume;
  bool front = true, back = true;  ///< of a card: which faces are drawn

  glm::vec3 right() const { return {shape[0], shape[1], shape[2]}; }
  glm::vec3 up() const { return {shape[3], shape[4], shape[5]}; }
};

/// Half-side of a card, in standard deviations of its sprite: there it ends, all around.
inline constexpr float kCardReach = 2.2f;
/// Of the Gaussian of a sprite within the border of its card: 1 - exp(-2.2^2 / 2).
inline constexpr float kWithinCard = 0.9111f;

/// A Gaussian blob with half-axes of one standard deviation (columns) whose optical depth along the shortest
/// of them is `frontalOpticalDepth`.
Blob volumeBlob(const glm::vec3& center, const glm::mat3& halfAxes, float frontalOpticalDepth);

/// A card that stays where it is, drawn from both sides; half-axes of one standard deviation.
Blob cardBlob(const glm::vec3& center, const glm::vec3& right, const glm::vec3& up, float opticalDepth);

}  // namespace cloudgen::check
