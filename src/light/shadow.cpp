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

/// Optical depths on a level plane, thrown there along the sun.
class ShadowPlane {
 public:
  ShadowPlane(std::span<const Caster> clouds, const glm::vec3& sun) {
    const float sine = std::max(sun.y, kLowestSine);
    const float level = std::hypot(sun.x, sun.z);
    const float run = std::sqrt(1 - sine * sine) / sine;
    if (level > 0) shift_ = glm::vec2(sun.x, sun.z) / level * run;
    slant_ = 1 / sine;
    glm::vec2 lower(1e30f), upper(-1e30f);
    for (const Caster& cloud : clouds)
      for (const float height : {cloud.base.y, cloud.base.y + cloud.depthMeters}) {
        lower = glm::min(lower, fallen(cloud, height) - cloud.radiusMeters);
        upper = glm::max(upper, fallen(cloud, height) + cloud.radiusMeters);
      }
    lower_ = lower;
    cell_ = std::max({kLeastCellMeters, (upper.x - lower.x) / kMostCells, (upper.y - lower.y) / kMostCells});
    columns_ = static_cast<int>((upper.x - lower.x) / cell_) + 1;
    rows_ = static_cast<int>((upper.y - lower.y) / cell_) + 1;
    depths_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0f);
  }

  /// Adds a slice; what it takes from the sun, depth times area, is kept whatever the cells.
  void add(const Caster& cloud, float height, float opticalDepth) {
    int cells = 0;
    visit(cloud, height, [&](float&) { ++cells; });
    const float area = std::numbers::pi_v<float> * cloud.radiusMeters * cloud.radiusMeters;
    const float each = opticalDepth * slant_ * area / (static_cast<float>(cells) * cell_ * cell_);
    visit(cloud, height, [&](float& depth) { depth += each; });
  }

  /// Mean over a cloud's area, at a height, of what comes through.
  float lightOn(const Caster& cloud, float height) {
    double sum = 0;
    int cells = 0;
    visit(cloud, height, [&](float& depth) {
      sum += transmitted((1 - kWaterAsymmetry) * depth);
      ++cells;
    });
    return static_cast<float>(sum / cells);
  }

 private:
  glm::vec2 fallen(const Caster& cloud, float height) const {
    return glm::vec2(cloud.base.x, cloud.base.z) - shift_ * height;
  }

  /// The cells whose middle lies in the cloud's disc, or the one that holds its middle.
  template <class Do>
  void visit(const Caster& cloud, float height, Do&& does) {
    const glm::vec2 middle = (fallen(cloud, height) - lower_) / cell_;
    const float radius = cloud.radiusMeters / cell_;
    const int top = std::max(0, static_cast<int>(middle.y - radius)),
              bottom = std::min(rows_ - 1, static_cast<int>(middle.y + radius));
    bool any = false;
    for (int row = top; row <= bottom; ++row) {
      const float y = static_cast<float>(row) + 0.5f - middle.y, half = radius * radius - y * y;
      if (half <= 0) continue;
      const float reach = std::sqrt(half);
      const int from = std::max(0, static_cast<int>(std::ceil(middle.x - reach - 0.5f))),
                to = std::min(columns_ - 1, static_cast<int>(std::floor(middle.x + reach - 0.5f)));
      for (int column = from; column <= to; ++column) {
        does(depths_[static_cast<std::size_t>(row) * columns_ + column]);
        any = true;
      }
    }
    if (!any)
      does(depths_[static_cast<std::size_t>(std::clamp(static_cast<int>(middle.y), 0, rows_ - 1)) * columns_ +
                   std::clamp(static_cast<int>(middle.x), 0, columns_ - 1)]);
  }

  glm::vec2 lower_{0}, shift_{0};
  float cell_ = 1, slant_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<float> depths_;
};

}  // namespace

std::vector<float> sunlightOf(std::span<const Caster> clouds, const glm::vec3& sunDirection) {
  std::vector<float> sunlight(clouds.size(), 1.0f);
  if (clouds.empty()) return sunlight;
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
  ShadowPlane plane(clouds, sunDirection);
  std::size_t next = 0;
  for (const std::uint32_t i : byTop) {
    for (; next < slices.size() && slices[next].bottom >= topOf(i); ++next)
      plane.add(clouds[slices[next].cloud], slices[next].heightMeters, slices[next].opticalDepth);
    if (next > 0) sunlight[i] = plane.lightOn(clouds[i], topOf(i));
  }
  return sunlight;
}

}  // namespace cloudgen::light
