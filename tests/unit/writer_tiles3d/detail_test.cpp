// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/detail.hpp"

#include <numbers>
#include <numeric>

#include "shape/plan.hpp"
#include "support/gltf_scene.hpp"
#include "writer/gltf/splat.hpp"
#include "writer/tiles3d/merging.hpp"
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

double meanRed(std::span<const LitPuff> puffs) {
  double sum = 0, weight = 0;
  for (const LitPuff& one : puffs) {
    const double cover = gltf::splatOpacity(one.puff) * one.puff.sigma.x * one.puff.sigma.z;
    sum += cover * one.light.color.r, weight += cover;
  }
  return sum / weight;
}

TEST(Detail, JoinedCloudsCoverAsMuchTogether) {
  scene::Scene scene = test::gltfScene(60, 16);
  for (scene::Archetype& archetype : scene.archetypes) archetype.onePuff.extinctionPerMeter *= 0.0005f;
  const auto clouds = allClouds(scene);
  std::vector<LitPuff> single;
  for (const scene::Instance& cloud : scene.instances) {
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    single.push_back({scene::placed(scene, cloud, scene.archetypes[lit.archetype].onePuff), lit.onePuff});
  }
  for (const Detail detail : {Detail{8000, 4000}, Detail{20'000, 8000}}) {
    const auto few = puffsAt(scene, clouds, detail);
    EXPECT_LT(few.size(), single.size() / 4);
    EXPECT_NEAR(covered(few) / covered(single), 1, 0.05);
    EXPECT_NEAR(meanRed(few), meanRed(single), 0.01);
  }
  for (scene::Archetype& archetype : scene.archetypes) archetype.onePuff.extinctionPerMeter *= 1e4f;
  for (const LitPuff& one : puffsAt(scene, clouds, {8000, 4000})) EXPECT_LE(gltf::splatOpacity(one.puff), 1);
}

TEST(Merging, FromAfarACloudIsFewerAndWiderPuffsThatCoverTheSameGround) {
  const scene::Scene scene = test::gltfScene(2000, 1);
  const auto all = puffsAt(scene, Clouds(allClouds(scene)).first(1), {});
  const auto square = [](std::span<const LitPuff> puffs) {
    // What they hide of the ground, on a raster of it.
    shape::PlanRaster raster({-3000, -3000}, {3000, 3000}, 200);
    glm::vec2 middle(puffs.front().puff.center.x, puffs.front().puff.center.z);
    for (const LitPuff& one : puffs) {
      shape::Puff puff = one.puff;
      puff.center -= glm::vec3(middle.x, 0, middle.y);
      const shape::PlanGaussian plan = shape::planOf(puff);
      const double depth = shape::extinctionArea(puff) / (2 * std::numbers::pi * std::sqrt(plan.determinant()));
      raster.add(plan, [depth](double gaussian) { return depth * gaussian; });
    }
    double hidden = 0;
    for (const float depth : raster.values()) hidden += -std::expm1(-static_cast<double>(depth));
    return hidden;
  };
  std::size_t most = all.size();
  for (const double error : {500.0, 700.0, 1000.0}) {
    const auto merged = mergedWithin(all, error);
    EXPECT_LT(merged.size(), most) << error;
    most = merged.size();
    for (const LitPuff& one : merged) {
      const float widest = std::max({one.puff.sigma.x, one.puff.sigma.y, one.puff.sigma.z});
      EXPECT_GE(widest, 0.999 * kLeastSigmaOfError * error) << "viewers leave out what is narrower";
      EXPECT_LE(widest, error / kVisibleSigmas);
    }
    EXPECT_NEAR(square(merged) / square(all), 1, 0.2) << error;
  }
}

TEST(Merging, APuffAloneIsAsMuchThinnerAsItIsWider) {
  LitPuff small;
  small.puff.sigma = {30, 20, 40};
  for (const float opticalDepth : {0.001f, 0.5f, 4.0f, 30.0f}) {
    small.puff.extinctionPerMeter = opticalDepth / shape::centralOpticalDepth(1, 20);
    const auto merged = mergedWithin({small}, 800);
    ASSERT_EQ(merged.size(), 1u);
    EXPECT_NEAR(merged[0].puff.sigma.z, 100, 0.01);
    const auto square = [](const shape::Puff& puff) {
      // What it hides of the ground: rings of its Gaussian from above.
      double sum = 0;
      for (double r = 0.005; r < 6; r += 0.01)
        sum += 0.01 * r * -std::expm1(-shape::frontalOpticalDepth(puff) * std::exp(-0.5 * r * r));
      return sum * puff.sigma.x * puff.sigma.z;
    };
    EXPECT_NEAR(square(merged[0].puff) / square(small.puff), 1, 0.01) << opticalDepth;
  }
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

TEST(TileTree, ASkyOfOneTileHasCoarserOnesAboveIt) {
  const scene::Scene scene = test::gltfScene(60, 4);
  const TileTree tree = tileTree(scene), near = tileTree(scene, kMostPuffsOfTile, 700);
  ASSERT_GE(tree.nodes.size(), 3u);
  EXPECT_EQ(tree.nodes.front().name(), "0_0_0_c" + std::to_string(tree.nodes.size() - 1));
  EXPECT_EQ(tree.nodes.back().name(), "0_0_0");
  EXPECT_TRUE(tree.nodes.back().isLeaf());
  const auto puffsOf = [&](const TileTree& of, const TileNode& node) {
    return puffsAt(scene, of.cloudsOf(node), node.detail).size();
  };
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    EXPECT_EQ(tree.nodes[i - 1].children, std::vector{static_cast<std::uint32_t>(i)});
    EXPECT_LT(puffsOf(tree, tree.nodes[i - 1]), puffsOf(tree, tree.nodes[i]));
  }
  EXPECT_GE(tree.nodes.front().detail.errorMeters, 22'000 / 16) << "the sky is hardly 16 of them wide";
  ASSERT_GE(near.nodes.size(), 2u);
  EXPECT_LE(near.nodes.front().detail.errorMeters, 700);
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
      if (!tree.nodes[child].isLeaf()) {
        EXPECT_GE(4 * tree.nodes[child].detail.errorMeters, node.detail.errorMeters) << "no leap";
      }
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
