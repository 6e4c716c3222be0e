// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/thread.hpp"
#include "light/color.hpp"
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
std::vector<LitPuff> turned(const scene::Scene& scene, const CloudLook& look,
                            std::span<const shape::Puff> puffs, std::span<const light::PuffLight> lights) {
  const scene::LitArchetype& lit = scene.lit[look.lit];
  const glm::quat turn = glm::angleAxis(scene::yawRadians(lit.yawStep), glm::vec3(0, 1, 0));
  // As bright as the pictures that stand for them further away, with what they send on to all sides.
  const auto colorOf = [&](const light::PuffLight& full) {
    const light::PuffLight left = light::inShadow(full, look.sunlight, scene.sun.color, scene.sky);
    return light::linearFromSrgb(light::encoded(left, scene.sun.color).mean);
  };
  std::vector<LitPuff> out;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    LitPuff one{puffs[i], i < lights.size() ? colorOf(lights[i]) : glm::vec3(1)};
    one.puff.center = turn * one.puff.center;
    one.puff.rotation = turn * one.puff.rotation;
    one.puff.extinctionPerMeter *= look.opticalDepthFactor;
    out.push_back(one);
  }
  return out;
}

std::vector<LitPuff> litPuffs(const scene::Scene& scene, const CloudLook& look, CloudDetail detail) {
  const scene::LitArchetype& lit = scene.lit[look.lit];
  const scene::Archetype& archetype = scene.archetypes[lit.archetype];
  if (detail == CloudDetail::Full || archetype.farPuffs.empty())
    return turned(scene, look, archetype.puffs, lit.puffs);
  return turned(scene, look, archetype.farPuffs, lit.farPuffs);
}

/// Heights between which a share of the extinction lies.
struct Extent {
  double lower = 0, upper = 0;
  double height() const { return upper - lower; }
};

constexpr double kBorderShare = 0.05, kEndShare = 0.01;

std::vector<shape::Puff> puffsOf(const std::vector<LitPuff>& members) {
  std::vector<shape::Puff> puffs;
  for (const LitPuff& lit : members) puffs.push_back(lit.puff);
  return puffs;
}

Extent extentOf(std::span<const shape::Puff> puffs, double beyond) {
  return {shape::heightOfShare(puffs, beyond), shape::heightOfShare(puffs, 1 - beyond)};
}

/// Of the same puffs without thickness.
Extent flatExtentOf(const std::vector<LitPuff>& members) {
  std::vector<shape::Puff> puffs = puffsOf(members);
  for (shape::Puff& puff : puffs) {
    const auto extinction = static_cast<float>(shape::extinctionArea(puff));
    puff.sigma = glm::vec3(1e-3f), puff.extinctionPerMeter = extinction;
  }
  return extentOf(puffs, kBorderShare);
}

/// Of puffs that lie in one plane a sixth stands below it and a sixth above: as high a cloud, with the mean
/// and variance of height of theirs (Gauss-Hermite quadrature of three nodes).
void standOnBothSides(std::vector<LitPuff>& members) {
  constexpr std::size_t kEach = 6, kBelow = 1, kAbove = 4;
  constexpr float kAway = 1.7321f;
  // Neighbours go different ways: every place has some of each.
  const shape::Bounds bounds = shape::boundsOf(puffsOf(members), 0);
  const int axis = bounds.upper.x - bounds.lower.x > bounds.upper.z - bounds.lower.z ? 0 : 2;
  std::stable_sort(members.begin(), members.end(), [&](const LitPuff& a, const LitPuff& b) {
    return a.puff.center[axis] < b.puff.center[axis];
  });
  for (std::size_t i = 0; i < members.size(); ++i) {
    const float upwards = i % kEach == kBelow ? -kAway : i % kEach == kAbove ? kAway : 0;
    members[i].puff.center.y += upwards * static_cast<float>(shape::heightDeviation(members[i].puff));
  }
}

/// Each puff as two with the same mean and variance of height. Mostly on one side: two equal quads would
/// cover less where their flanks meet others'.
void drawTwice(std::vector<LitPuff>& members) {
  constexpr float kShare = 0.85f;
  const std::size_t count = members.size();
  for (std::size_t i = 0; i < count; ++i) {
    LitPuff more = members[i], less = members[i];
    const float upwards = (i % 2 ? -1.0f : 1.0f) * static_cast<float>(shape::heightDeviation(members[i].puff));
    more.puff.extinctionPerMeter *= kShare, less.puff.extinctionPerMeter *= 1 - kShare;
    more.puff.center.y -= std::sqrt((1 - kShare) / kShare) * upwards;
    less.puff.center.y += std::sqrt(kShare / (1 - kShare)) * upwards;
    members[i] = more;
    members.push_back(less);
  }
}

/// Quads have no thickness: they stand further apart, so that they begin and end where the puffs do.
void spreadAsFlat(std::vector<LitPuff>& members) {
  constexpr double kMostStretch = 1.5;  ///< more of it would tear single puffs out of the cloud
  constexpr std::size_t kFew = 48;      ///< a part of a cloud of so few puffs would begin or end elsewhere
  const std::vector<shape::Puff> puffs = puffsOf(members);
  const Extent wanted = extentOf(puffs, kBorderShare), ends = extentOf(puffs, kEndShare);
  const auto isTooFlat = [&] {
    return wanted.height() > kMostStretch * flatExtentOf(members).height();
  };
  if (members.size() > kFew && isTooFlat()) standOnBothSides(members);
  if (members.size() <= kFew || isTooFlat()) drawTwice(members);
  const Extent flat = flatExtentOf(members);
  if (!(flat.height() > 0.05 * wanted.height())) return;
  const double stretch = std::min(kMostStretch, wanted.height() / flat.height());
  for (LitPuff& lit : members)
    lit.puff.center.y = static_cast<float>(std::clamp(
        0.5 * (wanted.lower + wanted.upper) + stretch * (lit.puff.center.y - 0.5 * (flat.lower + flat.upper)),
        ends.lower, ends.upper));
}

std::vector<Drawn> drawnTogether(const scene::Scene& scene, const CloudLook& look, CloudDetail detail) {
  const bool full = detail == CloudDetail::Full;
  const auto puffs = litPuffs(scene, look, detail);
  std::vector<shape::Puff> bare;
  for (const LitPuff& puff : puffs) bare.push_back(puff.puff);
  const std::span<const std::uint32_t> sections(scene.archetypes[scene.lit[look.lit].archetype].sectionStart);
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

float coveringOf(const scene::Scene& scene, const CloudLook& look, CloudDetail detail,
                 const image::SpriteAtlas& atlas) {
  auto all = drawnTogether(scene, look, detail);
  std::vector<shape::Puff> puffs;
  for (const LitPuff& one : litPuffs(scene, look, detail)) puffs.push_back(one.puff);
  const scene::Archetype& archetype = scene.archetypes[scene.lit[look.lit].archetype];
  const bool far = detail == CloudDetail::Simple && !archetype.farPuffs.empty();
  PlanOfQuads blended(puffs);
  blended.addBlended(puffs, far ? archetype.farCovering : archetype.covering);
  const double wanted = blended.coveredSquareMeters();
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
    const CloudLook look{static_cast<std::uint32_t>(i)};
    const image::SpriteAtlas& atlas = image::atlasOf(atlases, scene.archetypes[scene.lit[i].archetype].genus);
    if (wanted[i] & 1) full_[i] = coveringOf(scene, look, CloudDetail::Full, atlas);
    if (wanted[i] & 2) simple_[i] = coveringOf(scene, look, CloudDetail::Simple, atlas);
  });
}

std::vector<CloudPart> partsOf(const scene::Scene& scene, const CloudLook& look, CloudDetail detail,
                               float covering, const image::SpriteAtlas& atlas) {
  std::vector<CloudPart> parts;
  for (Drawn& drawn : drawnTogether(scene, look, detail)) {
    const bool turns = drawn.cluster.turns;
    parts.push_back({turns, turns ? drawn.cluster.center : glm::vec3(0), quadsOf(drawn, covering, atlas)});
  }
  return parts;
}

}  // namespace cloudgen::writer
