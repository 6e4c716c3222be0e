// SPDX-License-Identifier: Apache-2.0
#include "shape/plan.hpp"

#include <algorithm>
#include <cmath>
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

PlanRaster::Row PlanRaster::rowOf(const PlanGaussian& plan, int row, const Box& box, double ratioOfRatios) const {
  const double determinant = plan.determinant(), dz = lower_.y + (row + 0.5) * pixel_.y - plan.z;
  const double brightestX = plan.x + plan.xz / plan.zz * dz;
  const int brightest =
      std::clamp(static_cast<int>((brightestX - lower_.x) / pixel_.x), box.left, box.right);
  const double dx = lower_.x + (brightest + 0.5) * pixel_.x - plan.x;
  const double here = (plan.zz * dx * dx - 2 * plan.xz * dx * dz + plan.xx * dz * dz) / determinant;
  // Of the square of the distance: its change over a pixel is slope + bend to the right, -slope + bend to the left.
  const double slope = 2 * (plan.zz * dx - plan.xz * dz) * pixel_.x / determinant, bend = bendOf(plan);
  const double value = std::exp(-0.5 * here);
  return {brightest,
          {value, std::exp(-0.5 * (bend + slope)), ratioOfRatios},
          {value, std::exp(-0.5 * (bend - slope)), ratioOfRatios}};
}

}  // namespace cloudgen::shape
