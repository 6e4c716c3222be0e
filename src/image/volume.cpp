// SPDX-License-Identifier: Apache-2.0
#include "image/volume.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "base/noise.hpp"
#include "image/heap_noise.hpp"
#include "image/march.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

constexpr float kReach = 3.0f;  // deviations
// Without word of the phase: clouds this high are of ice.
constexpr double kWaterBelowMeters = 5500, kIceAboveMeters = 7500;

Blob blobOf(const Splat& splat, const View& view, const VolumeOptions& options) {
  const glm::dvec3 away = glm::dvec3(splat.center) - view.eye;
  const double distance =
      view.parallel ? std::max(0.0, -glm::dot(away, view.axes[2])) : std::max(1.0, glm::length(away));
  // No narrower than a pixel: a ray samples a point of it.
  const float least = static_cast<float>(0.5 * view.pixelMeters(distance));
  const glm::vec3 sigma = glm::max(splat.sigma, glm::vec3(std::max(least, 1e-3f)));
  const glm::vec3 grown = splat.sigma / sigma;
  const float narrowest = std::min({splat.sigma.x, splat.sigma.y, splat.sigma.z}),
              widest = std::max({splat.sigma.x, splat.sigma.y, splat.sigma.z});
  Blob blob;
  blob.center = away;
  const float depth = -std::log1p(-std::min(splat.opacity, 1 - 1e-7f));
  blob.extinction = depth / (2.5066283f * std::max(narrowest, 1e-6f)) * grown.x * grown.y * grown.z;
  const glm::mat3 axes = glm::mat3_cast(splat.rotation);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) blob.toUnit[k][i] = axes[i][k] / sigma[i];
  const glm::dvec3 direction = view.parallel ? -view.axes[2] : away / std::max(1e-9, glm::length(away));
  const float towards = static_cast<float>(glm::dot(direction, glm::dvec3(options.sunDirection)));
  blob.color = light::linearFromSrgb(glm::clamp(splat.color + splat.towardsSun * towards, 0.0f, 1.0f));
  blob.scale = std::cbrt(sigma.x * sigma.y * sigma.z);
  blob.billow = static_cast<float>(base::smoothStep(0.25, 0.62, narrowest / widest));
  const float middle = splat.sigma.x + splat.sigma.y + splat.sigma.z - narrowest - widest;
  const int longest = splat.sigma.x >= widest ? 0 : (splat.sigma.y >= widest ? 1 : 2);
  blob.fibre =
      axes[longest] * static_cast<float>(base::smoothStep(1.8, 3.5, widest / std::max(middle, 1e-6f)));
  blob.ice = static_cast<float>(base::smoothStep(kWaterBelowMeters, kIceAboveMeters, splat.center.y));
  blob.enter = static_cast<float>(distance) - kReach * std::max({sigma.x, sigma.y, sigma.z});
  return blob;
}

}  // namespace

Volume::Volume(std::span<const Splat> splats, const View& view, const VolumeOptions& options)
    : view_(view), options_(options) {
  const glm::dmat3 toView = glm::transpose(view.axes);
  for (const Splat& splat : splats) {
    if (!(splat.opacity > 1e-4f)) continue;
    const Blob blob = blobOf(splat, view, options);
    const float radius = kReach * std::max({splat.sigma.x, splat.sigma.y, splat.sigma.z});
    const glm::dvec3 p = toView * glm::dvec3(blob.center);
    if (-p.z < -radius) continue;
    // The box on the screen of the box about the Gaussian along the view's axes; where that comes too near
    // the eye, anywhere.
    const glm::mat3 axes = glm::mat3_cast(splat.rotation);
    const double pixel = 0.5 * view.pixelMeters(std::max(1.0, -p.z));
    glm::dvec3 half(0);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v = toView * glm::dvec3(axes[i] * std::max(splat.sigma[i], static_cast<float>(pixel)));
      half += v * v;
    }
    half = static_cast<double>(kReach) * glm::sqrt(half);
    const double near = -p.z - half.z;
    Box box{-1e30f, 1e30f, -1e30f, 1e30f};
    if (view.parallel || near > 1.0) {
      const auto span = [&](double middle, double reach, float& low, float& high, double offset,
                            double sign) {
        const double a = middle - reach, b = middle + reach, far = near + 2 * half.z;
        const double least = view.parallel ? a : std::min(a / near, a / far),
                     most = view.parallel ? b : std::max(b / near, b / far);
        const double one = offset + sign * view.focal * least, other = offset + sign * view.focal * most;
        low = static_cast<float>(std::min(one, other));
        high = static_cast<float>(std::max(one, other));
      };
      span(p.x, half.x, box.left, box.right, 0.5 * view.width, 1);
      span(p.y, half.y, box.top, box.bottom, 0.5 * view.height, -1);
    }
    if (box.right < 0 || box.left > static_cast<float>(view.width) || box.bottom < 0 ||
        box.top > static_cast<float>(view.height))
      continue;
    blobs_.push_back(blob);
    boxes_.push_back(box);
  }
  std::vector<std::uint32_t> order(blobs_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return blobs_[a].enter < blobs_[b].enter; });
  std::vector<Blob> blobs;
  std::vector<Box> boxes;
  blobs.reserve(order.size());
  boxes.reserve(order.size());
  for (const std::uint32_t i : order) {
    blobs.push_back(blobs_[i]);
    boxes.push_back(boxes_[i]);
  }
  blobs_ = std::move(blobs);
  boxes_ = std::move(boxes);
  all_.resize(blobs_.size());
  std::iota(all_.begin(), all_.end(), 0u);
}

std::vector<std::uint32_t> Volume::listFor(int left, int top, int width, int height,
                                           std::span<const std::uint32_t> among) const {
  const auto l = static_cast<float>(left), t = static_cast<float>(top), r = static_cast<float>(left + width),
             b = static_cast<float>(top + height);
  std::vector<std::uint32_t> list;
  for (const std::uint32_t i : among)
    if (boxes_[i].left <= r && boxes_[i].right >= l && boxes_[i].top <= b && boxes_[i].bottom >= t)
      list.push_back(i);
  return list;
}

float clarityThrough(const Haze& haze, double risePerMeter, float distanceMeters) {
  const float rise = static_cast<float>(risePerMeter * distanceMeters / haze.scaleHeightMeters);
  const float mean = std::abs(rise) < 1e-3f ? 1.0f : -std::expm1(-std::max(rise, -80.0f)) / rise;
  return std::exp(-distanceMeters * static_cast<float>(haze.perMeterAtEye) * mean);
}

float jitterAt(int x, int y) {
  const double turn = 0.06711056 * x + 0.00583715 * y;
  const double value = 52.9829189 * (turn - std::floor(turn));
  return static_cast<float>(value - std::floor(value));
}

std::vector<Blob> Volume::blobsOf(std::span<const std::uint32_t> list) const {
  std::vector<Blob> blobs;
  blobs.reserve(list.size());
  for (const std::uint32_t i : list) blobs.push_back(blobs_[i]);
  return blobs;
}

Gathered Volume::along(const Ray& ray, std::span<const Blob> blobs, double farMeters, float jitter,
                       const Haze& haze) const {
  return March(blobs, view_, options_, ray, haze).run(static_cast<float>(std::min(farMeters, 1e7)), jitter);
}

}  // namespace cloudgen::image
