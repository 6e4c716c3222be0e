// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_parts.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "light/shade.hpp"
#include "shape/heights.hpp"
#include "writer/x3d/clusters.hpp"

namespace cloudgen::writer {
namespace {

constexpr std::size_t kMostClusters = 24;  ///< parts of a cloud seen from near

/// Quads have no thickness: they stand further apart, so that they begin and end where the puffs do.
void spreadAsFlat(std::vector<LitPuff>& members) {
  constexpr double kBorderShare = 0.05, kEndShare = 0.01;
  std::vector<shape::Puff> puffs;
  for (const LitPuff& lit : members) puffs.push_back(lit.puff);
  const double lower = shape::heightOfShare(puffs, kBorderShare),
               upper = shape::heightOfShare(puffs, 1 - kBorderShare),
               lowest = shape::heightOfShare(puffs, kEndShare),
               highest = shape::heightOfShare(puffs, 1 - kEndShare);
  for (shape::Puff& puff : puffs) puff.sigma = glm::vec3(1e-3f), puff.extinctionPerMeter = 1;
  for (std::size_t i = 0; i < members.size(); ++i)
    puffs[i].extinctionPerMeter = static_cast<float>(shape::extinctionArea(members[i].puff));
  const double flatLower = shape::heightOfShare(puffs, kBorderShare),
               flatUpper = shape::heightOfShare(puffs, 1 - kBorderShare);
  if (!(flatUpper - flatLower > 0.05 * (upper - lower))) return;  // all in one plane
  const double stretch = std::min(3.0, (upper - lower) / (flatUpper - flatLower));
  for (LitPuff& lit : members)
    lit.puff.center.y = static_cast<float>(
        std::clamp(0.5 * (lower + upper) + stretch * (lit.puff.center.y - 0.5 * (flatLower + flatUpper)),
                   lowest, highest));
}

/// Puffs of a lit archetype, turned by its yaw.
std::vector<LitPuff> turned(const scene::Scene& scene, const scene::LitArchetype& lit, float sunlight,
                            std::span<const shape::Puff> puffs, std::span<const light::PuffLight> lights) {
  const glm::quat turn = glm::angleAxis(scene::yawRadians(lit.yawStep), glm::vec3(0, 1, 0));
  const glm::vec3 dimming = light::dimming(sunlight, scene.sun.color, scene.sky);
  std::vector<LitPuff> out;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    LitPuff one{puffs[i], dimming * (i < lights.size() ? lights[i].color : glm::vec3(1))};
    one.puff.center = turn * one.puff.center;
    one.puff.rotation = turn * one.puff.rotation;
    out.push_back(one);
  }
  return out;
}

std::vector<CloudPart> partsOf(const std::vector<LitPuff>& puffs, std::span<const std::uint32_t> sections,
                               std::size_t most, const image::SpriteAtlas& atlas) {
  std::vector<shape::Puff> bare;
  for (const LitPuff& lit : puffs) bare.push_back(lit.puff);
  std::vector<CloudPart> parts;
  for (const Cluster& cluster : clustersOf(bare, sections, most)) {
    std::vector<LitPuff> members;
    for (const std::uint32_t i : cluster.puffs) members.push_back(puffs[i]);
    if (cluster.turns) {
      parts.push_back({true, cluster.center, facingQuads(members, cluster.center, atlas)});
    } else {
      spreadAsFlat(members);
      parts.push_back({false, glm::vec3(0), crossedQuads(members, glm::vec3(0), atlas)});
    }
  }
  return parts;
}

}  // namespace

std::vector<CloudPart> fullParts(const scene::Scene& scene, std::uint32_t lit, float sunlight,
                                 const image::SpriteAtlas& atlas) {
  const scene::LitArchetype& light = scene.lit[lit];
  const scene::Archetype& archetype = scene.archetypes[light.archetype];
  return partsOf(turned(scene, light, sunlight, archetype.puffs, light.puffs), archetype.sectionStart,
                 kMostClusters, atlas);
}

std::vector<CloudPart> simpleParts(const scene::Scene& scene, std::uint32_t lit, float sunlight,
                                   const image::SpriteAtlas& atlas) {
  const scene::LitArchetype& light = scene.lit[lit];
  const scene::Archetype& archetype = scene.archetypes[light.archetype];
  const bool hasFar = !archetype.farPuffs.empty();
  return partsOf(turned(scene, light, sunlight, hasFar ? archetype.farPuffs : archetype.puffs,
                        hasFar ? light.farPuffs : light.puffs),
                 {}, 1, atlas);
}

}  // namespace cloudgen::writer
