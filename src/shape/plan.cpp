// SPDX-License-Identifier: Apache-2.0
#include "shape/plan.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

namespace cloudgen::shape {

PlanGaussian planOf(const Puff& puff, double unitMeters) {
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  PlanGaussian plan;
  plan.x = puff.center.x / unitMeters, plan.z = puff.center.z / unitMeters;
  for (int k = 0; k < 3; ++k) {
    const double x = puff.sigma[k] * axes[k].x / unitMeters, z = puff.sigma[k] * axes[k].z / unitMeters;
    plan.xx += x * x, plan.xz += x * z, plan.zz += z * z;
  }
  return plan;
}

PlanRaster::PlanRaster(const glm::dvec2& lower, const glm::dvec2& upper, int pixels)
    : lower_(lower), pixel_((upper - lower) / static_cast<double>(pixels)), pixels_(pixels) {
  values_.assign(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), 0.0f);
}

PlanRaster::Box PlanRaster::boxOf(const PlanGaussian& plan) const {
  constexpr double kReach = 3.5;
  const double acrossX = kReach * std::sqrt(plan.xx), acrossZ = kReach * std::sqrt(plan.zz);
  const auto pixelOf = [&](double from, double size) {
    return std::clamp(static_cast<int>(from / size), 0, pixels_ - 1);
  };
  return {pixelOf(plan.x - acrossX - lower_.x, pixel_.x), pixelOf(plan.x + acrossX - lower_.x, pixel_.x),
          pixelOf(plan.z - acrossZ - lower_.y, pixel_.y), pixelOf(plan.z + acrossZ - lower_.y, pixel_.y)};
}

}  // namespace cloudgen::shape
