// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "shape/plan.hpp"

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

PlanRaster rasterAround(std::span<const Puff> puffs) {
  constexpr int kPixels = 64;
  const Bounds bounds = boundsOf(puffs, 3.5f);
  return {{bounds.lower.x, bounds.lower.z}, {bounds.upper.x, bounds.upper.z}, kPixels};
}

double squareMeters(const PlanRaster& raster, std::size_t pixels) {
  return static_cast<double>(pixels) * raster.pixel().x * raster.pixel().y;
}

/// A blended blob from above.
struct Blended {
  PlanGaussian plan;
  float opacity;
};

/// How many of the doubtful pixels have more than kCoveringOpticalDepth of the blobs.
std::size_t coveredOf(const std::vector<bool>& doubtful, std::span<const Blended> blobs, PlanRaster raster) {
  constexpr float kNoDoubt = -1;
  raster.fill([&](std::size_t pixel) { return doubtful[pixel] ? 0 : kNoDoubt; });
  for (const Blended& blob : blobs)
    raster.visit(blob.plan, [&](float& depth, double gaussian) {
      if (depth != kNoDoubt) depth += -std::log1p(-blob.opacity * static_cast<float>(gaussian));
    });
  return static_cast<std::size_t>(std::ranges::count_if(
      raster.values(), [](float depth) { return depth > kCoveringOpticalDepth; }));
}

/// As blendedSquareMeters(), but counts no further than it has more than `enough`. Nearly all pixels are told by what
/// the blobs let through together, without logarithms and in single precision; where that lies within its errors of the
/// threshold, their depths are added up.
double blendedUpTo(double enough, std::span<const Puff> puffs, float covering) {
  constexpr float kMostOpaque = 1 - 0x1p-20f;
  std::vector<Puff> widened;
  std::vector<Blended> blobs;
  for (const Puff& puff : puffs) {
    widened.push_back(widenedAcross(puff, covering));
    blobs.push_back({planOf(widened.back()),
                     std::min(kMostOpaque, -std::expm1(-frontalOpticalDepth(widened.back())))});
  }
  PlanRaster raster = rasterAround(widened);
  const auto threshold = static_cast<float>(std::exp(-kCoveringOpticalDepth));
  const float error = 1e-5f + 2.5e-7f * static_cast<float>(blobs.size());
  const float covered = threshold - error, open = threshold + error;
  // Values are what is stopped, so that they begin with 0; 1 where it is known that enough is.
  std::size_t known = 0;
  for (const Blended& blob : blobs) {
    if (squareMeters(raster, known) > enough) return squareMeters(raster, known);
    raster.visit(blob.plan, [&](float& stopped, double gaussian) {
      if (stopped == 1) return;
      const float through = (1 - stopped) * (1 - blob.opacity * static_cast<float>(gaussian));
      stopped = through < covered ? 1 : 1 - through;
      known += stopped == 1;
    });
  }
  std::vector<bool> doubtful;
  for (const float stopped : raster.values()) doubtful.push_back(stopped < 1 && 1 - stopped < open);
  if (std::ranges::find(doubtful, true) != doubtful.end()) known += coveredOf(doubtful, blobs, raster);
  return squareMeters(raster, known);
}

}  // namespace

double coveredSquareMeters(std::span<const Puff> puffs) {
  PlanRaster raster = rasterAround(puffs);
  std::size_t covered = 0;
  for (const Puff& puff : puffs) {
    const PlanGaussian plan = planOf(puff);
    const double middle = extinctionArea(puff) / (2 * std::numbers::pi * std::sqrt(plan.determinant()));
    covered +=
        raster.addUpTo(kCoveringOpticalDepth, plan, [middle](double gaussian) { return middle * gaussian; });
  }
  return squareMeters(raster, covered);
}

double blendedSquareMeters(std::span<const Puff> puffs, float covering) {
  return blendedUpTo(std::numeric_limits<double>::infinity(), puffs, covering);
}

float coveringOf(std::span<const Puff> puffs) {
  const double wanted = coveredSquareMeters(puffs);
  return coveringThat(wanted, [&](float covering) { return blendedUpTo(wanted, puffs, covering); });
}

}  // namespace cloudgen::shape
