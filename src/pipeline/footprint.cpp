// SPDX-License-Identifier: Apache-2.0
#include "pipeline/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace cloudgen::pipeline {
namespace {

/// A puff seen from above: a Gaussian in the plane.
struct Shadow {
  double x = 0, z = 0, xx = 0, xz = 0, zz = 0, peak = 0;
};

Shadow shadowOf(const shape::Puff& puff, double widthMeters, double share) {
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  Shadow shadow;
  shadow.x = puff.center.x / widthMeters, shadow.z = puff.center.z / widthMeters;
  for (int k = 0; k < 3; ++k) {
    const double x = puff.sigma[k] * axes[k].x / widthMeters, z = puff.sigma[k] * axes[k].z / widthMeters;
    shadow.xx += x * x, shadow.xz += x * z, shadow.zz += z * z;
  }
  shadow.peak = share;
  return shadow;
}

}  // namespace

Footprint::Footprint(std::span<const shape::Puff> puffs, double widthMeters) {
  const shape::Bounds bounds = shape::boundsOf(puffs, 3.5f);
  lower_ = glm::dvec2(bounds.lower.x, bounds.lower.z) / widthMeters;
  upper_ = glm::dvec2(bounds.upper.x, bounds.upper.z) / widthMeters;
  reach_ = std::hypot(std::max(-lower_.x, upper_.x), std::max(-lower_.y, upper_.y));
  double total = 0, smallest = 0;
  for (const shape::Puff& puff : puffs) {
    total += shape::extinctionArea(puff);
    smallest += std::min(puff.sigma.x, puff.sigma.z) / static_cast<double>(puffs.size());
  }
  // Two thirds of a puff's deviation tell it from the next.
  const double extent = std::max(upper_.x - lower_.x, upper_.y - lower_.y) * widthMeters;
  pixels_ = static_cast<int>(std::clamp(1.5 * extent / smallest, 32.0, 160.0));
  values_.assign(static_cast<std::size_t>(pixels_ * pixels_), 0.0f);
  const glm::dvec2 pixel = (upper_ - lower_) / static_cast<double>(pixels_);
  perWidth_ = 1.0 / pixel;
  for (const shape::Puff& puff : puffs) {
    Shadow shadow = shadowOf(puff, widthMeters, shape::extinctionArea(puff) / total);
    shadow.xx += pixel.x * pixel.x / 12, shadow.zz += pixel.y * pixel.y / 12;  // the mean over a pixel
    const double determinant = shadow.xx * shadow.zz - shadow.xz * shadow.xz;
    const double peak = shadow.peak / (2 * std::numbers::pi * std::sqrt(determinant));
    const double acrossX = 3.5 * std::sqrt(shadow.xx), acrossZ = 3.5 * std::sqrt(shadow.zz);
    const auto pixelOf = [&](double from, double size) {
      return std::clamp(static_cast<int>(from / size), 0, pixels_ - 1);
    };
    for (int row = pixelOf(shadow.z - acrossZ - lower_.y, pixel.y);
         row <= pixelOf(shadow.z + acrossZ - lower_.y, pixel.y); ++row)
      for (int column = pixelOf(shadow.x - acrossX - lower_.x, pixel.x);
           column <= pixelOf(shadow.x + acrossX - lower_.x, pixel.x); ++column) {
        const double dx = lower_.x + (column + 0.5) * pixel.x - shadow.x,
                     dz = lower_.y + (row + 0.5) * pixel.y - shadow.z;
        const double q = (shadow.zz * dx * dx - 2 * shadow.xz * dx * dz + shadow.xx * dz * dz) / determinant;
        values_[static_cast<std::size_t>(row * pixels_ + column)] +=
            static_cast<float>(peak * std::exp(-0.5 * q));
      }
  }
  double painted = 0;
  for (const float value : values_) painted += value * pixel.x * pixel.y;
  for (float& value : values_) value = static_cast<float>(value / painted);
  waterOfBrightest_ = values_;
  std::sort(waterOfBrightest_.begin(), waterOfBrightest_.end(), std::greater<>());
  float most = 0;
  for (std::size_t n = waterOfBrightest_.size(); n > 0; --n) {
    most = std::max(most, static_cast<float>(n) * waterOfBrightest_[n - 1]);
    waterOfBrightest_[n - 1] = most;
  }
}

double Footprint::coveredAlone(double opticalDepth, double threshold) const {
  const double pixel = (upper_.x - lower_.x) * (upper_.y - lower_.y) / static_cast<double>(values_.size());
  // The n brightest pixels are covered if the n-th is above the threshold with the water that n pixels have:
  // the greatest such n.
  const double least = threshold / (opticalDepth * pixel);
  const auto end = std::partition_point(waterOfBrightest_.begin(), waterOfBrightest_.end(),
                                        [&](float water) { return water > least; });
  return std::max<double>(1, static_cast<double>(end - waterOfBrightest_.begin())) * pixel;
}

const Footprint& FootprintBook::of(const ArchetypeKey& key) {
  Entry* entry = nullptr;
  {
    const std::lock_guard lock(mutex_);
    entry = &entries_[key];
  }
  std::call_once(entry->once, [&] {
    const ArchetypeShape made = shapeOf(key, options_, general_);
    entry->footprint = std::make_unique<Footprint>(made.cloud.puffs, made.widthMeters);
  });
  return *entry->footprint;
}

}  // namespace cloudgen::pipeline
