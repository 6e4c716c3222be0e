// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace cloudgen::image {

struct Camera {
  glm::dvec3 eye{0}, target{0, 0, -1};
  double verticalFieldDegrees = 45;
  int width = 960, height = 540;
};

/// A ray of a picture; `direction` is a unit vector.
struct Ray {
  glm::dvec3 origin{0}, direction{0, 0, -1};
};

/// How pixels and space belong together: in perspective, or with parallel rays.
struct View {
  glm::dvec3 eye{0};
  glm::dmat3 axes{1};  ///< columns: right, up, back
  double focal = 1;    ///< pixels of a unit slope; with parallel rays pixels of a metre
  bool parallel = false;
  int width = 0, height = 0;

  /// Through a place in the picture, pixels from the upper left corner; the middle of pixel (i, j) is
  /// (i + 0.5, j + 0.5).
  Ray rayAt(double x, double y) const;
  /// Metres that a pixel spans at a distance.
  double pixelMeters(double distance) const { return parallel ? 1.0 / focal : distance / focal; }
};

View viewOf(const Camera& camera);

/// Parallel rays along -`back` (a unit vector) that cover a square of 2 x `halfMeters`; they start `distance`
/// metres before its centre.
View parallelView(const glm::dvec3& center, const glm::dvec3& back, double halfMeters, double distance,
                  int pixels);

}  // namespace cloudgen::image
