// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/cloud_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "light/color.hpp"
#include "light/shade.hpp"

namespace cloudgen::writer {
namespace {

constexpr float kFlat = 0.35f;    ///< height to width of what is flat
constexpr float kCoarser = 0.4f;  ///< what is seen from far off only, or from below
constexpr float kFiner = 0.7f;    ///< the upright ones of a shell, which stand for a turning one

/// From beside the sun: half of what one sees is lit, as it is from all sides on the whole.
Sight besideSun(const light::Sun& sun) {
  constexpr glm::vec3 kUp(0, 1, 0);
  const double azimuth = (sun.azimuthDegrees + 60) * std::numbers::pi / 180;
  const glm::vec3 towards(std::sin(azimuth), 0, -std::cos(azimuth));
  return {glm::cross(kUp, towards), kUp, towards};
}

/// The height at which a cloud is widest.
float widestHeight(std::span<const shape::Puff> puffs, const shape::Bounds& box) {
  constexpr std::size_t kSlices = 5;
  const float step = std::max((box.upper.y - box.lower.y) / kSlices, 1e-3f);
  std::array<std::vector<shape::Puff>, kSlices> slices;
  for (const shape::Puff& puff : puffs)
    slices[static_cast<std::size_t>(glm::clamp((puff.center.y - box.lower.y) / step, 0.0f, kSlices - 1.0f))]
        .push_back(puff);
  const auto width = [](const std::vector<shape::Puff>& slice) {
    const shape::Bounds own = shape::boundsOf(slice, 2);
    return (own.upper.x - own.lower.x) * (own.upper.z - own.lower.z);
  };
  const auto widest = std::ranges::max_element(slices, {}, width);
  return box.lower.y + step * (static_cast<float>(widest - slices.begin()) + 0.5f);
}

/// Those from above upwards, then those from below downwards.
std::vector<CloudPicture> levelPictures(const LitCloud& cloud, const std::vector<Part>& layers,
                                        const Fineness& above, const Fineness& below) {
  std::vector<CloudPicture> pictures;
  for (auto layer = layers.begin(); layer != layers.end(); ++layer)
    pictures.push_back(cloud.seen(*layer, kFromAbove, above));
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    pictures.push_back(cloud.seen(*layer, kFromBelow, below));
  return pictures;
}

bool isFlat(const LitCloud& cloud) { return cloud.size().y < kFlat * cloud.width(); }

/// Two, if it has some height, and is no storm that is wide by its anvil: nothing would be between them.
std::vector<Part> flatLayers(const LitCloud& cloud) {
  constexpr float kThin = 0.1f, kTallMeters = 2500;
  const float height = cloud.size().y;
  if (height < kThin * cloud.width() || height > kTallMeters) return {cloud.whole()};
  return cloud.layers(1, 2);
}

float pixelsPerMeterOf(const LitCloud& cloud, int pixels) {
  return static_cast<float>(pixels) / std::max({cloud.width(), cloud.size().y, 1e-3f});
}

}  // namespace

void appendColored(const scene::Scene& scene, const scene::Instance& instance, const Sight& sight,
                   std::vector<ColoredPuff>& out) {
  constexpr std::size_t kMostPuffs = 2000;
  const scene::LitArchetype& lit = scene.lit[instance.lit];
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  const bool inFull = archetype.puffs.size() <= kMostPuffs || archetype.farPuffs.empty();
  const auto& puffs = inFull ? archetype.puffs : archetype.farPuffs;
  const auto& lights = inFull ? lit.puffs : lit.farPuffs;
  for (std::size_t p = 0; p < puffs.size(); ++p) {
    const light::PuffLight left = light::inShadow(lights[p], instance.sunlight, scene.sun.color, scene.sky);
    out.push_back({scene::placed(scene, instance, puffs[p]),
                   light::encoded(left, scene.sun.color).seenAt(meanCosine(sight, scene.sun))});
  }
}

glm::vec3 middleOf(const CloudPicture& one) {
  const glm::vec2 middle = 0.5f * (one.picture.lower + one.picture.upper);
  return middle.x * one.sight.right + middle.y * one.sight.up + one.picture.surface * one.sight.towards;
}

int pixelsOfEach(std::size_t clouds, double squares, const PictureSize& size) {
  constexpr int kFewestPixels = 24;
  const double each = size.together / (squares * static_cast<double>(std::max<std::size_t>(clouds, 1)));
  return std::clamp(static_cast<int>(std::sqrt(each)), kFewestPixels, size.longestSide);
}

CloudPictures picturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels) {
  const LitCloud cloud(scene, lit, 1);
  const float pixelsPerMeter = pixelsPerMeterOf(cloud, pixels);
  CloudPictures all;
  if (isFlat(cloud)) {
    all.level = levelPictures(cloud, flatLayers(cloud), {pixelsPerMeter}, {pixelsPerMeter});
    return all;
  }
  all.level = levelPictures(cloud, {cloud.whole()}, {pixelsPerMeter}, {kCoarser * pixelsPerMeter});
  // Lower down they would be seen as brims below what stands.
  const shape::Bounds& box = cloud.box();
  all.level[0].picture.surface =
      std::max(widestHeight(cloud.puffs(), box), 0.5f * (box.lower.y + box.upper.y));
  all.level[1].picture.surface = -all.level[0].picture.surface;
  for (const auto& [one, other] : {std::pair{kFromSouth, kFromNorth}, {kFromEast, kFromWest}}) {
    CloudPicture front = cloud.seen(cloud.whole(), one, {kCoarser * pixelsPerMeter}),
                 back = cloud.seen(cloud.whole(), other, {kCoarser * pixelsPerMeter});
    front.picture.surface = 0.5f * (front.picture.surface - back.picture.surface);
    back.picture.surface = -front.picture.surface;
    all.upright.push_back(std::move(front));
    all.upright.push_back(std::move(back));
  }
  return all;
}

NearPictures nearPicturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels) {
  const LitCloud cloud(scene, lit, 1);
  const Fineness fine{pixelsPerMeterOf(cloud, pixels)};
  if (isFlat(cloud)) return {levelPictures(cloud, flatLayers(cloud), fine, fine), false};
  NearPictures near{{cloud.seenAt(0, cloud.whole(), besideSun(scene.sun), fine)}, true};
  near.pictures[0].picture.surface = 0;
  near.pictures[0].sight = kFromSouth;
  return near;
}

std::vector<CloudPicture> shellPictures(const scene::Scene& scene, std::uint32_t lit, int pixels,
                                        float opticalDepthFactor) {
  constexpr int kReliefCells = 14;
  constexpr float kSheet = 0.15f,
                  kSheer = 1;  // height to width, or mean optical depth, of what shows no sides
  // Level looks meet two upright sides, by the mean of the cosine and the sine 4 / pi of one.
  constexpr float kUprightShare = std::numbers::pi_v<float> / 4;
  const LitCloud cloud(scene, lit, opticalDepthFactor);
  const float pixelsPerMeter = pixelsPerMeterOf(cloud, pixels);
  const Fineness fine{pixelsPerMeter, kReliefCells}, side{kFiner * pixelsPerMeter, kReliefCells},
      coarse{kCoarser * pixelsPerMeter, kReliefCells};
  if (cloud.size().y < kSheet * cloud.width() || cloud.meanOpticalDepth() < kSheer)
    return levelPictures(cloud, flatLayers(cloud), fine, fine);
  auto pictures = levelPictures(cloud, {cloud.whole()}, fine, coarse);
  for (const Sight& sight : {kFromSouth, kFromNorth, kFromEast, kFromWest})
    pictures.push_back(cloud.seen(cloud.whole(), sight, side, kUprightShare));
  return pictures;
}

glm::vec3 tintOf(const scene::Scene& scene, std::uint32_t lit, float sunlight) {
  const glm::vec3 color = scene.lit[lit].onePuff.color,
                  dimmed = light::dimming(sunlight, scene.sun.color, scene.sky) * color;
  return glm::min(light::srgbFromLinear(dimmed) / glm::max(light::srgbFromLinear(color), 1e-3f), 1.0f);
}

}  // namespace cloudgen::writer
