// SPDX-License-Identifier: Apache-2.0
#include "runtime/camera.hpp"

#include <algorithm>

namespace cloudgen::runtime {
namespace {

constexpr float kQuarterTurn = 1.5707963f;

}  // namespace

float Camera::focalPixels() const noexcept {
  return 0.5f * static_cast<float>(heightPixels) / std::tan(0.5f * verticalFieldRadians);
}

Frustum::Frustum(const Camera& camera, float marginRadians, float marginMeters) noexcept {
  const Vec3 ahead = normalized(camera.forward), right = normalized(cross(ahead, camera.up)),
             up = cross(right, ahead);
  const float focal = camera.focalPixels();
  const float halfWidth = std::atan(0.5f * static_cast<float>(camera.widthPixels) / focal),
              halfHeight = 0.5f * camera.verticalFieldRadians;
  const auto side = [&](const Vec3& across, float halfAngle) {
    // A wedge of more than half a turn keeps nothing out.
    const float angle = std::min(halfAngle + marginRadians, kQuarterTurn);
    const Vec3 normal = ahead * std::sin(angle) + across * std::cos(angle);
    return Plane{normal, marginMeters - dot(normal, camera.eye)};
  };
  const float reach = camera.farMeters + marginMeters;
  planes_ = {side(right, halfWidth),
             side(right * -1, halfWidth),
             side(up, halfHeight),
             side(up * -1, halfHeight),
             Plane{ahead, marginMeters + reach * std::sin(std::min(marginRadians, kQuarterTurn)) - dot(ahead, camera.eye)},
             Plane{ahead * -1, reach + dot(ahead, camera.eye)}};
}

Side Frustum::sideOfBox(const Vec3& lower, const Vec3& upper) const noexcept {
  const Vec3 middle = (lower + upper) * 0.5f, half = (upper - lower) * 0.5f;
  bool inside = true;
  for (const Plane& plane : planes_) {
    const float away = dot(plane.normal, middle) + plane.offset;
    const float reach = std::abs(plane.normal.x) * half.x + std::abs(plane.normal.y) * half.y +
                        std::abs(plane.normal.z) * half.z;
    if (away < -reach) return Side::Outside;
    inside &= away >= reach;
  }
  return inside ? Side::Inside : Side::Across;
}

bool Frustum::meetsSphere(const Vec3& center, float radius) const noexcept {
  for (const Plane& plane : planes_)
    if (dot(plane.normal, center) + plane.offset < -radius) return false;
  return true;
}

}  // namespace cloudgen::runtime
