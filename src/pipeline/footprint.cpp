// SPDX-License-Identifier: Apache-2.0
#include "pipeline/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "shape/blending.hpp"
#include "shape/plan.hpp"

namespace cloudgen::pipeline {
namespace {

HeightMoments momentsOf(const shape::Puff& puff, double widthMeters) {
  const double mean = puff.center.y / widthMeters, deviation = shape::heightDeviation(puff) / widthMeters;
  return {static_cast<float>(mean), static_cast<float>(mean * mean + deviation * deviation)};
}

}  // namespace

Footprint::Footprint(std::span<const shape::Puff> puffs, double widthMeters)
    : Footprint(puffs, widthMeters, false) {}

Footprint Footprint::asDrawn(std::span<const shape::Puff> puffs, double widthMeters) {
  const float covering = shape::coveringOf(puffs);
  std::vector<shape::Puff> widened;
  for (const shape::Puff& puff : puffs) widened.push_back(shape::widenedAcross(puff, covering));
  return {widened, widthMeters, true};
}

Footprint::Footprint(std::span<const shape::Puff> puffs, double widthMeters, bool blended) {
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
  shape::PlanRaster raster(lower_, upper_, pixels_);
  const glm::dvec2 pixel = raster.pixel();
  perWidth_ = 1.0 / pixel;
  heights_.resize(raster.values().size());
  for (const shape::Puff& puff : puffs) {
    shape::PlanGaussian plan = shape::planOf(puff, widthMeters);
    plan.xx += pixel.x * pixel.x / 12, plan.zz += pixel.y * pixel.y / 12;  // the mean over a pixel
    // In widths, as the plan: the optical depth of all of the extinction over the square of the width.
    const double peak =
        shape::extinctionArea(puff) / total / (2 * std::numbers::pi * std::sqrt(plan.determinant()));
    const HeightMoments own = momentsOf(puff, widthMeters);
    const auto addTo = [&](auto profile) {
      raster.visit(plan, [&](float& value, double gaussian) {
        const auto here = static_cast<float>(profile(gaussian));
        HeightMoments& moments = heights_[static_cast<std::size_t>(&value - raster.values().data())];
        value += here, moments.mean += here * own.mean, moments.square += here * own.square;
      });
    };
    if (blended)
      addTo(shape::BlendedProfile(peak * total / (widthMeters * widthMeters)));
    else
      addTo([peak](double gaussian) { return peak * gaussian; });
  }
  values_ = raster.values();
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (values_[i] > 0) heights_[i].mean /= values_[i], heights_[i].square /= values_[i];
  double painted = 0;
  for (const float value : values_) painted += value * pixel.x * pixel.y;
  if (blended) drawnShare_ = painted * widthMeters * widthMeters / total;
  for (float& value : values_) value = static_cast<float>(value / painted);
  waterOfBrightest_ = values_;
  // Most are 0 already, and last.
  const auto some = std::partition(waterOfBrightest_.begin(), waterOfBrightest_.end(),
                                   [](float value) { return value != 0; });
  std::sort(waterOfBrightest_.begin(), some, std::greater<>());
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
  const double least = threshold / (opticalDepth * drawnShare_ * pixel);
  const auto end = std::partition_point(waterOfBrightest_.begin(), waterOfBrightest_.end(),
                                        [&](float water) { return water > least; });
  return std::max<double>(1, static_cast<double>(end - waterOfBrightest_.begin())) * pixel;
}

template <class Made, class Make>
const Made& FootprintBook::oneOf(std::map<ArchetypeKey, Entry<Made>>& entries, const ArchetypeKey& key, Make make) {
  Entry<Made>* entry = nullptr;
  {
    const std::lock_guard lock(mutex_);
    entry = &entries[key];
  }
  std::call_once(entry->once, [&] { entry->made = std::make_unique<Made>(make()); });
  return *entry->made;
}

const Footprint& FootprintBook::of(const ArchetypeKey& key) {
  return oneOf(footprints_, key, [&] {
    const ArchetypeKey shapeKey = shapeKeyOf(key);
    const ArchetypeShape& shape = oneOf(shapes_, shapeKey, [&] { return shapeOf(shapeKey, options_, general_); });
    return Footprint::asDrawn(inClassOf(key, shape).cloud.puffs, shape.widthMeters);
  });
}

}  // namespace cloudgen::pipeline
