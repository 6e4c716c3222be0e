// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_parts.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "base/thread.hpp"
#include "light/shade.hpp"
#include "shape/heights.hpp"
#include "writer/x3d/clusters.hpp"
#include "writer/x3d/plan_of_quads.hpp"

namespace cloudgen::writer {
namespace {

constexpr std::size_t kMostClusters = 24;  ///< parts of a cloud seen from near

/// Puffs that are drawn together.
struct Drawn {
  Cluster cluster;
  std::vector<LitPuff> members;
};

/// The puffs of a lit archetype, turned by its yaw.
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

std::vector<LitPuff> litPuffs(const scene::Scene& scene, const scene::LitArchetype& lit, float sunlight,
                              CloudDetail detail) {
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  if (detail == CloudDetail::Full || archetype.farPuffs.empty())
    return turned(scene, lit, sunlight, archetype.puffs, lit.puffs);
  return turned(scene, lit, sunlight, archetype.farPuffs, lit.farPuffs);
}

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

std::vector<Drawn> drawnTogether(const scene::Scene& scene, std::uint32_t index, float sunlight,
                                 CloudDetail detail) {
  const scene::LitArchetype& lit = scene.lit[index];
  const bool full = detail == CloudDetail::Full;
  const auto puffs = litPuffs(scene, lit, sunlight, detail);
  std::vector<shape::Puff> bare;
  for (const LitPuff& puff : puffs) bare.push_back(puff.puff);
  const std::span<const std::uint32_t> sections(scene.archetypes[lit.archetype].sectionStart);
  std::vector<Drawn> all;
  for (Cluster& cluster : clustersOf(bare, full ? sections : sections.first(0), full ? kMostClusters : 1)) {
    Drawn drawn{std::move(cluster), {}};
    for (const std::uint32_t i : drawn.cluster.puffs) drawn.members.push_back(puffs[i]);
    if (!drawn.cluster.turns) spreadAsFlat(drawn.members);
    all.push_back(std::move(drawn));
  }
  return all;
}

QuadMesh quadsOf(Drawn& drawn, float covering, const image::SpriteAtlas& atlas) {
  for (LitPuff& lit : drawn.members) lit.covering = covering;
  return drawn.cluster.turns ? facingQuads(drawn.members, drawn.cluster.center, atlas)
                             : crossedQuads(drawn.members, glm::vec3(0), atlas);
}

float coveringOf(const scene::Scene& scene, std::uint32_t lit, CloudDetail detail,
                 const image::SpriteAtlas& atlas) {
  auto all = drawnTogether(scene, lit, 1, detail);
  std::vector<shape::Puff> puffs;
  for (const LitPuff& one : litPuffs(scene, scene.lit[lit], 1, detail)) puffs.push_back(one.puff);
  const double wanted = shape::coveredSquareMeters(puffs);
  return shape::coveringThat(wanted, [&](float tried) {
    PlanOfQuads plan(puffs);
    for (Drawn& drawn : all) {
      if (drawn.cluster.turns)
        plan.addTurning(quadsOf(drawn, tried, atlas), drawn.cluster.center);
      else
        plan.add(quadsOf(drawn, tried, atlas));
    }
    return plan.coveredSquareMeters();
  });
}

}  // namespace

Coverings::Coverings(const scene::Scene& scene, const std::vector<image::SpriteAtlas>& atlases,
                     const std::vector<bool>& full)
    : full_(scene.lit.size(), 0), simple_(scene.lit.size(), 0) {
  std::vector<unsigned char> wanted(scene.lit.size(), 0);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) wanted[scene.instances[i].lit] |= full[i] ? 1 : 2;
  base::parallelFor(scene.lit.size(), [&](std::size_t i) {
    const auto lit = static_cast<std::uint32_t>(i);
    const image::SpriteAtlas& atlas = image::atlasOf(atlases, scene.archetypes[scene.lit[i].archetype].genus);
    if (wanted[i] & 1) full_[i] = coveringOf(scene, lit, CloudDetail::Full, atlas);
    if (wanted[i] & 2) simple_[i] = coveringOf(scene, lit, CloudDetail::Simple, atlas);
  });
}

std::vector<CloudPart> partsOf(const scene::Scene& scene, std::uint32_t lit, float sunlight,
                               CloudDetail detail, float covering, const image::SpriteAtlas& atlas) {
  std::vector<CloudPart> parts;
  for (Drawn& drawn : drawnTogether(scene, lit, sunlight, detail)) {
    const bool turns = drawn.cluster.turns;
    parts.push_back({turns, turns ? drawn.cluster.center : glm::vec3(0), quadsOf(drawn, covering, atlas)});
  }
  return parts;
}

}  // namespace cloudgen::writer
