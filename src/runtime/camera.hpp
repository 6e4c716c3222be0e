// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "runtime/vec3.hpp"

namespace cloudgen::runtime {

/// Where one looks from, and where to.
struct Camera {
  Vec3 eye;
  Vec3 forward{0, 0, -1}, up{0, 1, 0};  ///< need not be unit vectors, nor at right angles
  float verticalFieldRadians = 0.785398f;
  int widthPixels = 1280, heightPixels = 720;
  float farMeters = 400'000;

  /// Pixels that a metre across spans at a metre's distance.
  float focalPixels() const noexcept;
};

enum class Side { Outside, Across, Inside };

/// What a camera may see, widened so that it holds until the camera has moved or turned by a little.
class Frustum {
 public:
  Frustum() = default;
  /// Each side is turned outwards by `marginRadians` and moved outwards by `marginMeters`.
  Frustum(const Camera& camera, float marginRadians, float marginMeters) noexcept;

  Side sideOfBox(const Vec3& lower, const Vec3& upper) const noexcept;
  bool meetsSphere(const Vec3& center, float radius) const noexcept;

 private:
  struct Plane {
    Vec3 normal;  ///< inwards
    float offset = 0;
  };
  std::array<Plane, 6> planes_{};
};

}  // namespace cloudgen::runtime
