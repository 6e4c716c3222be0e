// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
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

double covered(const PlanRaster& raster) {
  const auto over =
      std::ranges::count_if(raster.values(), [](float depth) { return depth > kCoveringOpticalDepth; });
  return static_cast<double>(over) * raster.pixel().x * raster.pixel().y;
}

}  // namespace

double coveredSquareMeters(std::span<const Puff> puffs) {
  PlanRaster raster = rasterAround(puffs);
  for (const Puff& puff : puffs) {
    const PlanGaussian plan = planOf(puff);
    const double middle = extinctionArea(puff) / (2 * std::numbers::pi * std::sqrt(plan.determinant()));
    raster.add(plan, [middle](double gaussian) { return middle * gaussian; });
  }
  return covered(raster);
}

double blendedSquareMeters(std::span<const Puff> puffs, float covering) {
  std::vector<Puff> widened;
  for (const Puff& puff : puffs) widened.push_back(widenedAcross(puff, covering));
  PlanRaster raster = rasterAround(widened);
  for (const Puff& puff : widened) raster.add(planOf(puff), BlendedProfile(frontalOpticalDepth(puff)));
  return covered(raster);
}

float coveringOf(std::span<const Puff> puffs) {
  return coveringThat(coveredSquareMeters(puffs),
                      [&](float covering) { return blendedSquareMeters(puffs, covering); });
}

}  // namespace cloudgen::shape
