// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/detail.hpp"

#include <numeric>

#include "support/gltf_scene.hpp"
#include "writer/gltf/splat.hpp"
#include "writer/tiles3d/narrow.hpp"
#include "writer/tiles3d/tile_tree.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

std::vector<std::uint32_t> allClouds(const scene::Scene& scene) {
  std::vector<std::uint32_t> all(scene.instances.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// What the puffs cover if they do not overlap, but for a factor.
double covered(std::span<const LitPuff> puffs) {
  double sum = 0;
  for (const LitPuff& one : puffs)
    sum += static_cast<double>(gltf::splatOpacity(one.puff)) * one.puff.sigma.x * one.puff.sigma.z;
  return sum;
}

TEST(Detail, FitsTheBudgetAndLosesNoMoreThanItMust) {
  const scene::Scene scene = test::gltfScene(500, 8);
  const auto clouds = allClouds(scene);
  double lastError = -1;
  for (const std::size_t budget : {100'000u, 20'000u, 2'000u, 300u, 70u, 30u, 5u}) {
    const Detail detail = detailWithin(scene, clouds, budget, 0);
    EXPECT_LE(puffsAt(scene, clouds, detail).size(), budget);
    EXPECT_GE(detail.errorMeters, lastError) << budget;
    lastError = detail.errorMeters;
  }
  EXPECT_EQ(detailWithin(scene, clouds, 100'000, 0).errorMeters, 0) << "all puffs fit";
  EXPECT_GE(detailWithin(scene, clouds, 2'000, 5000).errorMeters, 5000);
}

TEST(Detail, JoinedCloudsCoverAsMuchTogether) {
  scene::Scene scene = test::gltfScene(60, 16);
  for (scene::Archetype& archetype : scene.archetypes) archetype.onePuff.extinctionPerMeter *= 0.0005f;
  const auto clouds = allClouds(scene);
  const auto single = puffsAt(scene, clouds, {1e6, 0}), few = puffsAt(scene, clouds, {1e6, 4000});
  EXPECT_EQ(single.size(), clouds.size());
  EXPECT_LT(few.size(), single.size() / 4);
  EXPECT_NEAR(covered(few) / covered(single), 1, 0.05);
  for (scene::Archetype& archetype : scene.archetypes) archetype.onePuff.extinctionPerMeter *= 1e4f;
  for (const LitPuff& one : puffsAt(scene, clouds, {1e6, 4000})) EXPECT_LE(gltf::splatOpacity(one.puff), 1);
  const auto meanRed = [](std::span<const LitPuff> puffs) {
    double sum = 0, weight = 0;
    for (const LitPuff& one : puffs) {
      const double cover = gltf::splatOpacity(one.puff) * one.puff.sigma.x * one.puff.sigma.z;
      sum += cover * one.light.color.r, weight += cover;
    }
    return sum / weight;
  };
  EXPECT_NEAR(meanRed(few), meanRed(single), 0.01);
}

TEST(Narrow, ManyHoldAndSpreadAsTheOneThatIsTooWide) {
  LitPuff wide;
  wide.puff.rotation = glm::angleAxis(0.4f, glm::vec3(0, 1, 0));
  wide.puff.center = {1000, 2000, -500};
  for (const glm::vec3 sigma : {glm::vec3(100, 50, 200), glm::vec3(300, 80, 240), glm::vec3(700, 100, 2000)}) {
    wide.puff.sigma = sigma;
    wide.puff.extinctionPerMeter = 0.01f;
    std::vector<LitPuff> parts;
    appendNarrow(wide, parts);
    EXPECT_LE(parts.size(), narrowCount(wide.puff));
    double held = 0;
    glm::dvec3 mean(0), square(0);
    for (const LitPuff& part : parts) {
      for (int axis = 0; axis < 3; ++axis) EXPECT_LE(part.puff.sigma[axis], kMostSigmaMeters);
      EXPECT_GE(gltf::splatOpacity(part.puff), gltf::kLeastOpacity);
      const double own = shape::extinctionArea(part.puff);
      const glm::dvec3 away(glm::inverse(wide.puff.rotation) * (part.puff.center - wide.puff.center));
      held += own;
      mean += own * away;
      square += own * (away * away + glm::dvec3(part.puff.sigma) * glm::dvec3(part.puff.sigma));
    }
    EXPECT_NEAR(held / shape::extinctionArea(wide.puff), 1, 1e-4);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(mean[axis] / held, 0, 0.01 * static_cast<double>(sigma[axis]));
      EXPECT_NEAR(std::sqrt(square[axis] / held) / static_cast<double>(sigma[axis]), 1, 0.04);
    }
  }
}

TEST(TileTree, HoldsEveryCloudOnceALevelAndErrorsFall) {
  const scene::Scene scene = test::gltfScene(3000, 10);
  const TileTree tree = tileTree(scene);
  ASSERT_GT(tree.nodes.size(), 4u);
  std::vector<int> inLeaves(scene.instances.size(), 0);
  for (const TileNode& node : tree.nodes) {
    const auto clouds = tree.cloudsOf(node);
    EXPECT_FALSE(clouds.empty());
    EXPECT_LE(puffsAt(scene, clouds, node.detail).size(), kMostPuffsOfTile);
    if (node.isLeaf()) {
      EXPECT_EQ(node.detail.errorMeters, 0);
      for (const std::uint32_t cloud : clouds) ++inLeaves[cloud];
    }
    std::size_t below = 0;
    for (const std::uint32_t child : node.children) {
      below += tree.nodes[child].count;
      EXPECT_LT(tree.nodes[child].detail.errorMeters, node.detail.errorMeters);
    }
    if (!node.isLeaf()) {
      EXPECT_EQ(below, node.count);
    }
  }
  for (const int count : inLeaves) EXPECT_EQ(count, 1);
  EXPECT_TRUE(tileTree({.frame = base::LocalFrame({0, 0, 1, 1})}).nodes.empty());
}

}  // namespace
}  // namespace cloudgen::writer::tiles3d
