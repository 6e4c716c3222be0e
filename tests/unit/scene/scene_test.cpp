// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/gltf_scene.hpp"
#include "support/moving_scene.hpp"

namespace cloudgen::scene {
namespace {

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

/// One instance with the given yaw step, of a cloud with one puff at (100, 50, 0) that is long along x.
Scene oneCloud(int yawStep, Instance instance) {
  Scene scene{.frame = base::LocalFrame({0, 0, 1, 1})};
  shape::Puff puff{.center = {100, 50, 0}, .sigma = {30, 10, 5}, .extinctionPerMeter = 0.01f};
  scene.archetypes = {{.name = "A", .puffs = {puff}, .bounds = {{0, 0, -10}, {200, 90, 10}}}};
  scene.lit = {{.archetype = 0, .yawStep = yawStep, .puffs = {{}}}};
  scene.instances = {instance};
  return scene;
}

TEST(Scene, YawTurnsEastTowardsNorth) {
  EXPECT_FLOAT_EQ(yawRadians(4), static_cast<float>(std::numbers::pi / 2));
  const Scene scene = oneCloud(4, {.position = {1000, 500, -2000}});
  const shape::Puff puff = placed(scene, scene.instances[0], scene.archetypes[0].puffs[0]);
  // Counter-clockwise seen from above: +x (east) becomes -z (north).
  expectNear(puff.center, {1000, 550, -2100}, 1e-3f);
  expectNear(puff.rotation * glm::vec3(1, 0, 0), {0, 0, -1}, 1e-5f);
}

TEST(Scene, ScaleKeepsTheOpticalDepthAndTheFactorMultipliesIt) {
  Scene scene = oneCloud(3, {.scale = 2.5f, .opticalDepthFactor = 1});
  const shape::Puff& puff = scene.archetypes[0].puffs[0];
  const shape::Puff scaled = placed(scene, scene.instances[0], puff);
  EXPECT_FLOAT_EQ(scaled.sigma.x, 75);
  EXPECT_NEAR(shape::frontalOpticalDepth(scaled), shape::frontalOpticalDepth(puff), 1e-5);
  scene.instances[0].opticalDepthFactor = 3;
  EXPECT_NEAR(shape::frontalOpticalDepth(placed(scene, scene.instances[0], puff)),
              3 * shape::frontalOpticalDepth(puff), 1e-5);
  // Water (extinction area) grows with the footprint.
  EXPECT_NEAR(shape::extinctionArea(scaled) / shape::extinctionArea(puff), 2.5 * 2.5, 1e-4);
}

TEST(Scene, DrawnPuffsCountsEveryInstance) {
  const Scene scene = test::gltfScene(60, 4);
  EXPECT_EQ(drawnPuffs(scene), 19u * 60 + 2);
}

TEST(Scene, HighestTopIsThatOfTheCloudRecords) {
  EXPECT_FLOAT_EQ(highestTop(test::gltfScene()), 8750);
  EXPECT_FLOAT_EQ(highestTop(Scene{.frame = base::LocalFrame({0, 0, 1, 1})}), 0);
}

TEST(Tiles, HoldEveryInstanceOnceRowByRowFromTheNorthWest) {
  const Scene scene = test::gltfScene();
  const float sideMeters = 3000;
  const auto tiles = tilesOf(scene, sideMeters);
  std::vector<std::uint32_t> seen;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (t > 0) {
      EXPECT_LT(std::pair(tiles[t - 1].row, tiles[t - 1].column), std::pair(tiles[t].row, tiles[t].column));
    }
    EXPECT_TRUE(std::is_sorted(tiles[t].instances.begin(), tiles[t].instances.end()));
    for (const auto i : tiles[t].instances) {
      seen.push_back(i);
      EXPECT_EQ(tiles[t].column, static_cast<int>(std::floor(scene.instances[i].position.x / sideMeters)));
      EXPECT_EQ(tiles[t].row, static_cast<int>(std::floor(scene.instances[i].position.z / sideMeters)));
    }
  }
  std::sort(seen.begin(), seen.end());
  ASSERT_EQ(seen.size(), scene.instances.size());
  for (std::uint32_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i);
  EXPECT_EQ(tiles.front().instances, std::vector<std::uint32_t>{17})
      << "the green cloud stands farthest north";
}

TEST(Tiles, BoxesHoldThePuffsHoweverTheCloudIsTurned) {
  const Scene scene = test::gltfScene();
  for (const Tile& tile : tilesOf(scene, 5000))
    for (const auto i : tile.instances)
      for (const auto& puff : scene.archetypes[scene.lit[scene.instances[i].lit].archetype].puffs) {
        const glm::vec3 center = placed(scene, scene.instances[i], puff).center;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(center, tile.lower)) &&
                    glm::all(glm::lessThanEqual(center, tile.upper)));
      }
}

TEST(StandingAt, HasTheCloudsOfItsTimeAndTheirRecords) {
  Scene scene = test::gltfScene();
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) scene.clouds.resize(i + 1), scene.clouds[i].id = i;
  scene = test::moving(std::move(scene));
  const Scene still = standingAt(scene, 3600);
  EXPECT_EQ(still.validTime.seconds, scene.validTime.seconds + 3600);
  EXPECT_TRUE(still.keySeconds.empty() && still.timeSeconds.empty() && still.motions.empty());
  ASSERT_EQ(still.clouds.size(), still.instances.size());
  const auto moved = instancesAt(scene, 3600);
  std::size_t there = 0;
  for (const Instance& cloud : moved) there += cloud.opticalDepthFactor > 0;
  EXPECT_EQ(still.instances.size(), there);
  for (std::size_t i = 0; i < still.instances.size(); ++i)
    EXPECT_EQ(still.instances[i].position, moved[still.clouds[i].id].position);
}

TEST(Tiles, NoCloudsNoTiles) {
  EXPECT_TRUE(tilesOf(Scene{.frame = base::LocalFrame({0, 0, 1, 1})}, 1000).empty());
}

}  // namespace
}  // namespace cloudgen::scene
