// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

namespace cloudgen::shape {

float blendedWidening(float opticalDepth, float covering) {
  const auto reachOf = [](float ratio) { return std::sqrt(2 * std::log(std::max(ratio, 1.0f))); };
  const float wanted = reachOf(opticalDepth / covering);
  float widening = 1;
  for (int pass = 0; pass < 4; ++pass) {
    const float opacity = -std::expm1(-opticalDepth / (widening * widening));
    const float reach = reachOf(opacity / -std::expm1(-covering));
    if (!(reach > 0.5f)) break;  // so thin that all of it is about to go under
    widening = std::clamp(wanted / reach, 1.0f, 2.0f);
  }
  return widening;
}

Puff widenedAcross(Puff puff, float covering) {
  const float by = blendedWidening(frontalOpticalDepth(puff), covering);
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  for (int i = 0; i < 3; ++i) {
    const float along = glm::mix(by, 1.0f, axes[i].y * axes[i].y);
    puff.sigma[i] *= along;
    puff.extinctionPerMeter /= along;
  }
  return puff;
}

namespace {

/// Optical depth straight down on a square raster around puffs.
class Raster {
 public:
  explicit Raster(std::span<const Puff> puffs) {
    const Bounds bounds = boundsOf(puffs, kReach);
    lower_ = {bounds.lower.x, bounds.lower.z};
    pixelMeters_ =
        std::max({bounds.upper.x - bounds.lower.x, bounds.upper.z - bounds.lower.z, 1.0f}) / kPixels;
    depths_.assign(kPixels * kPixels, 0.0f);
  }

  /// `drawn` tells the optical depth of a place from that of the puff's middle and the Gaussian there.
  template <class Drawn>
  void add(const Puff& puff, Drawn drawn) {
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    float xx = 0, xz = 0, zz = 0;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 axis = puff.sigma[k] * axes[k];
      xx += axis.x * axis.x, xz += axis.x * axis.z, zz += axis.z * axis.z;
    }
    const float determinant = std::max(xx * zz - xz * xz, 1e-6f);
    const auto middle = static_cast<float>(
        extinctionArea(puff) / (2 * std::numbers::pi * std::sqrt(static_cast<double>(determinant))));
    const glm::ivec2 first = pixelAt(puff.center.x - kReach * std::sqrt(xx),
                                     puff.center.z - kReach * std::sqrt(zz)),
                     last = pixelAt(puff.center.x + kReach * std::sqrt(xx),
                                    puff.center.z + kReach * std::sqrt(zz));
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) {
        const float x = lower_.x + (static_cast<float>(column) + 0.5f) * pixelMeters_ - puff.center.x,
                    z = lower_.y + (static_cast<float>(row) + 0.5f) * pixelMeters_ - puff.center.z;
        const float q = (zz * x * x - 2 * xz * x * z + xx * z * z) / determinant;
        depths_[static_cast<std::size_t>(row * kPixels + column)] += drawn(middle, std::exp(-0.5f * q));
      }
  }

  double squareMetersOver(double threshold) const {
    const auto over =
        std::count_if(depths_.begin(), depths_.end(), [&](float depth) { return depth > threshold; });
    return static_cast<double>(over) * pixelMeters_ * pixelMeters_;
  }

 private:
  static constexpr int kPixels = 64;
  static constexpr float kReach = 3.5f;

  glm::ivec2 pixelAt(float x, float z) const {
    const auto pixel = [&](float meters) {
      return std::clamp(static_cast<int>(meters / pixelMeters_), 0, kPixels - 1);
    };
    return {pixel(x - lower_.x), pixel(z - lower_.y)};
  }

  glm::vec2 lower_{0};
  float pixelMeters_ = 1;
  std::vector<float> depths_;
};

}  // namespace

double coveredSquareMeters(std::span<const Puff> puffs, double threshold) {
  Raster raster(puffs);
  for (const Puff& puff : puffs)
    raster.add(puff, [](float middle, float gaussian) { return middle * gaussian; });
  return raster.squareMetersOver(threshold);
}

double blendedSquareMeters(std::span<const Puff> puffs, double threshold, float covering) {
  std::vector<Puff> widened;
  for (const Puff& puff : puffs) widened.push_back(widenedAcross(puff, covering));
  Raster raster(widened);
  constexpr float kMostOpaque = 1 - 0x1p-20f;
  for (const Puff& puff : widened) {
    const float opacity = std::min(kMostOpaque, -std::expm1(-frontalOpticalDepth(puff)));
    raster.add(puff, [opacity](float, float gaussian) { return -std::log1p(-opacity * gaussian); });
  }
  return raster.squareMetersOver(threshold);
}

float coveringOf(std::span<const Puff> puffs, double threshold) {
  const double wanted = coveredSquareMeters(puffs, threshold);
  float low = 0.001f, high = 0.3f;
  for (int pass = 0; pass < 5; ++pass) {
    const float middle = std::sqrt(low * high);
    (blendedSquareMeters(puffs, threshold, middle) > wanted ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace cloudgen::shape
