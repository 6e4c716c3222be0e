// SPDX-License-Identifier: Apache-2.0
#include "light/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "light/octaves.hpp"
#include "light/optics.hpp"

namespace cloudgen::light {
namespace {

constexpr int kMostCells = 1024;
constexpr float kLeastCellMeters = 50, kSliceMeters = 800, kLowestSine = 0.139f;

/// A level piece of a cloud: taller clouds are several.
struct Slice {
  float bottom;
  std::uint32_t cloud;
  float heightMeters, opticalDepth;
};

}  // namespace

ShadowPlane::ShadowPlane(std::span<const Caster> clouds, const glm::vec3& sun) {
  const float sine = std::max(sun.y, kLowestSine);
  const float level = std::hypot(sun.x, sun.z);
  const float run = std::sqrt(1 - sine * sine) / sine;
  if (level > 0) shift_ = glm::vec2(sun.x, sun.z) / level * run;
  slant_ = 1 / sine;
  if (clouds.empty()) return;
  glm::vec2 lower(1e30f), upper(-1e30f);
  for (const Caster& cloud : clouds)
    for (const float height : {cloud.base.y, cloud.base.y + cloud.depthMeters}) {
      const glm::vec2 middle = fallen({cloud.base.x, height, cloud.base.z});
      lower = glm::min(lower, middle - cloud.radiusMeters);
      upper = glm::max(upper, middle + cloud.radiusMeters);
    }
  lower_ = lower;
  cell_ = std::max({kLeastCellMeters, (upper.x - lower.x) / kMostCells, (upper.y - lower.y) / kMostCells});
  columns_ = static_cast<int>((upper.x - lower.x) / cell_) + 1;
  rows_ = static_cast<int>((upper.y - lower.y) / cell_) + 1;
  depths_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0f);
}

glm::vec2 ShadowPlane::fallen(const glm::vec3& point) const {
  return glm::vec2(point.x, point.z) - shift_ * point.y;
}

template <class Do>
void ShadowPlane::visit(const Caster& cloud, float heightMeters, Do&& does) const {
  const glm::vec2 middle = (fallen({cloud.base.x, heightMeters, cloud.base.z}) - lower_) / cell_;
  const float radius = cloud.radiusMeters / cell_;
  const int top = std::max(0, static_cast<int>(middle.y - radius)),
            bottom = std::min(rows_ - 1, static_cast<int>(middle.y + radius));
  const auto cell = [&](int column, int row) { return static_cast<std::size_t>(row) * columns_ + column; };
  bool any = false;
  for (int row = top; row <= bottom; ++row) {
    const float y = static_cast<float>(row) + 0.5f - middle.y, half = radius * radius - y * y;
    if (half <= 0) continue;
    const float reach = std::sqrt(half);
    const int from = std::max(0, static_cast<int>(std::ceil(middle.x - reach - 0.5f))),
              to = std::min(columns_ - 1, static_cast<int>(std::floor(middle.x + reach - 0.5f)));
    for (int column = from; column <= to; ++column) {
      does(cell(column, row));
      any = true;
    }
  }
  if (!any)
    does(cell(std::clamp(static_cast<int>(middle.x), 0, columns_ - 1),
              std::clamp(static_cast<int>(middle.y), 0, rows_ - 1)));
}

void ShadowPlane::add(const Caster& cloud, float heightMeters, float opticalDepth) {
  int cells = 0;
  visit(cloud, heightMeters, [&](std::size_t) { ++cells; });
  const float area = std::numbers::pi_v<float> * cloud.radiusMeters * cloud.radiusMeters;
  const float each = opticalDepth * slant_ * area / (static_cast<float>(cells) * cell_ * cell_);
  visit(cloud, heightMeters, [&](std::size_t cell) { depths_[cell] += each; });
}

float ShadowPlane::lightOn(const Caster& cloud, float heightMeters) const {
  double sum = 0;
  int cells = 0;
  visit(cloud, heightMeters, [&](std::size_t cell) {
    sum += transmitted((1 - kWaterAsymmetry) * depths_[cell]);
    ++cells;
  });
  return static_cast<float>(sum / cells);
}

float ShadowPlane::opticalDepthTo(const glm::vec3& point) const {
  const glm::vec2 place = (fallen(point) - lower_) / cell_ - 0.5f;
  const glm::vec2 corner = glm::floor(place), share = place - corner;
  const auto at = [&](float x, float y) {
    if (x < 0 || y < 0 || x >= static_cast<float>(columns_) || y >= static_cast<float>(rows_)) return 0.0f;
    return depths_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
  };
  return glm::mix(glm::mix(at(corner.x, corner.y), at(corner.x + 1, corner.y), share.x),
                  glm::mix(at(corner.x, corner.y + 1), at(corner.x + 1, corner.y + 1), share.x), share.y);
}

Shadows shadowsOf(std::span<const Caster> clouds, const glm::vec3& sunDirection) {
  Shadows shadows{std::vector<float>(clouds.size(), 1.0f), {}};
  if (clouds.empty() || sunDirection.y <= 0) return shadows;
  std::vector<Slice> slices;
  std::vector<std::uint32_t> byTop;
  for (std::uint32_t i = 0; i < clouds.size(); ++i) {
    byTop.push_back(i);
    const int count = std::clamp(static_cast<int>(std::ceil(clouds[i].depthMeters / kSliceMeters)), 1, 20);
    const float thickness = clouds[i].depthMeters / static_cast<float>(count);
    for (int k = 0; k < count; ++k) {
      const float bottom = clouds[i].base.y + static_cast<float>(k) * thickness;
      slices.push_back(
          {bottom, i, bottom + 0.5f * thickness, clouds[i].opticalDepth / static_cast<float>(count)});
    }
  }
  const auto topOf = [&](std::uint32_t i) { return clouds[i].base.y + clouds[i].depthMeters; };
  std::stable_sort(slices.begin(), slices.end(),
                   [](const Slice& a, const Slice& b) { return a.bottom > b.bottom; });
  std::stable_sort(byTop.begin(), byTop.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return topOf(a) > topOf(b); });

  // From the top downwards: a cloud meets the slices above its top, so neither itself nor its neighbours in
  // a layer, whose shade the archetype's light holds already.
  shadows.whole = ShadowPlane(clouds, sunDirection);
  std::size_t next = 0;
  const auto add = [&](const Slice& slice) {
    shadows.whole.add(clouds[slice.cloud], slice.heightMeters, slice.opticalDepth);
  };
  for (const std::uint32_t i : byTop) {
    for (; next < slices.size() && slices[next].bottom >= topOf(i); ++next)
      add(slices[next]);
    if (next > 0) shadows.sunlight[i] = shadows.whole.lightOn(clouds[i], topOf(i));
  }
  for (; next < slices.size(); ++next) add(slices[next]);
  return shadows;
}

}  // namespace cloudgen::light
