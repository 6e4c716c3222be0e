// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/cloud_pictures.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "light/color.hpp"
#include "light/shade.hpp"

namespace cloudgen::writer {
namespace {

const glm::vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
const Sight kFromAbove{kX, -kZ, kY}, kFromBelow{kX, kZ, -kY};
/// The four sides, as pairs that look at each other.
const std::array<std::pair<Sight, Sight>, 2> kAcross{
    {{{kX, kY, kZ}, {-kX, kY, -kZ}}, {{-kZ, kY, kX}, {kZ, kY, -kX}}}};

constexpr float kFlat = 0.35f;    ///< height to width of what is flat
constexpr float kCoarser = 0.4f;  ///< what is seen from far off only, or from below

std::vector<ColoredPuff> turned(const scene::Scene& scene, const scene::LitArchetype& lit) {
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  const glm::quat turn = glm::angleAxis(scene::yawRadians(lit.yawStep), kY);
  std::vector<ColoredPuff> out;
  for (std::size_t i = 0; i < archetype.puffs.size(); ++i) {
    shape::Puff puff = archetype.puffs[i];
    puff.center = turn * puff.center;
    puff.rotation = turn * puff.rotation;
    out.push_back({puff, light::srgbFromLinear(lit.puffs[i].color)});
  }
  return out;
}

/// From beside the sun: half of what one sees is lit, as it is from all sides on the whole.
Sight besideSun(const light::Sun& sun) {
  const double azimuth = (sun.azimuthDegrees + 60) * std::numbers::pi / 180;
  const glm::vec3 towards(std::sin(azimuth), 0, -std::cos(azimuth));
  return {glm::cross(kY, towards), kY, towards};
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

}  // namespace

void appendColored(const scene::Scene& scene, const scene::Instance& instance,
                   std::vector<ColoredPuff>& out) {
  constexpr std::size_t kMostPuffs = 2000;
  const scene::LitArchetype& lit = scene.lit[instance.lit];
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  const bool inFull = archetype.puffs.size() <= kMostPuffs || archetype.farPuffs.empty();
  const auto& puffs = inFull ? archetype.puffs : archetype.farPuffs;
  const auto& lights = inFull ? lit.puffs : lit.farPuffs;
  const glm::vec3 dimming = light::dimming(instance.sunlight, scene.sun.color, scene.sky);
  for (std::size_t p = 0; p < puffs.size(); ++p)
    out.push_back(
        {scene::placed(scene, instance, puffs[p]), light::srgbFromLinear(dimming * lights[p].color)});
}

glm::vec3 middleOf(const CloudPicture& one) {
  const glm::vec2 middle = 0.5f * (one.picture.lower + one.picture.upper);
  return middle.x * one.sight.right + middle.y * one.sight.up + one.picture.surface * one.sight.towards;
}

CloudPictures picturesOf(const scene::Scene& scene, std::uint32_t lit, int pixels) {
  const std::vector<ColoredPuff> puffs = turned(scene, scene.lit[lit]);
  std::vector<shape::Puff> bare;
  for (const ColoredPuff& puff : puffs) bare.push_back(puff.puff);
  const shape::Bounds box = shape::boundsOf(bare, 2);
  const glm::vec3 size = box.upper - box.lower;
  const float width = std::max(size.x, size.z), longest = std::max(width, size.y);
  const float pixelsPerMeter = static_cast<float>(pixels) / std::max(longest, 1e-3f);
  const auto painted = [&](const Sight& sight, float fineness) {
    return CloudPicture{paintedPuffs(puffs, sight, fineness * pixelsPerMeter), sight};
  };
  CloudPictures all;
  all.level = {painted(kFromAbove, 1), painted(kFromBelow, kCoarser)};
  if (size.y < kFlat * width) return all;
  // Lower down they would be seen as brims below what stands.
  all.level[0].picture.surface = std::max(widestHeight(bare, box), 0.5f * (box.lower.y + box.upper.y));
  all.level[1].picture.surface = -all.level[0].picture.surface;
  for (const auto& [one, other] : kAcross) {
    CloudPicture front = painted(one, kCoarser), back = painted(other, kCoarser);
    front.picture.surface = 0.5f * (front.picture.surface - back.picture.surface);
    back.picture.surface = -front.picture.surface;
    all.upright.push_back(std::move(front));
    all.upright.push_back(std::move(back));
  }
  all.turning = {painted(besideSun(scene.sun), 1)};
  all.turning[0].picture.surface = 0;
  all.turning[0].sight = kAcross[0].first;
  return all;
}

glm::vec3 tintOf(const scene::Scene& scene, std::uint32_t lit, float sunlight) {
  const glm::vec3 color = scene.lit[lit].onePuff.color,
                  dimmed = light::dimming(sunlight, scene.sun.color, scene.sky) * color;
  return glm::min(light::srgbFromLinear(dimmed) / glm::max(light::srgbFromLinear(color), 1e-3f), 1.0f);
}

}  // namespace cloudgen::writer
