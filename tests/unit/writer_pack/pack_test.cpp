// SPDX-License-Identifier: Apache-2.0
// What the pack says is what the scene holds; read by the validator and by the reader of verify, which share no code
// with the writer.
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/pack/read_pack.hpp"
#include "check/pack/validate_pack.hpp"
#include "shape/blending.hpp"
#include "support/pack_scene.hpp"
#include "support/scratch.hpp"
#include "writer/pack/quantise.hpp"

namespace cloudgen::writer {
namespace {

std::string findingsOf(std::string_view bytes) {
  std::string all;
  for (const check::Finding& finding : check::validatePack(bytes, "made.cgpack").findings)
    all += check::text(finding) + "\n";
  return all;
}

TEST(Pack, PassesItsValidator) {
  EXPECT_EQ(findingsOf(test::packOf(test::packScene())), "");
  EXPECT_EQ(findingsOf(test::packOf(test::wideSky(8, 40, 500, 100'000))), "");
}

TEST(Pack, TheFileHasRealSprites) {
  const test::Scratch folder;
  const scene::Scene scene = test::packScene();
  writePack(scene, {folder.path(), {}});
  const std::string bytes = base::readFile(folder.path() / "scene.cgpack");
  EXPECT_EQ(findingsOf(bytes), "");
  EXPECT_GT(bytes.size(), test::packOf(scene).size() + 100'000);
  EXPECT_LT(bytes.size(), test::packOf(scene).size() + 700'000);
}

TEST(Pack, ASkyWithoutCloudsIsAPack) {
  scene::Scene scene = test::packScene();
  scene.instances.clear();
  scene.clouds.clear();
  scene.lit.clear();
  scene.archetypes.clear();
  EXPECT_EQ(findingsOf(test::packOf(scene)), "");
}

TEST(Pack, SameSceneSameBytes) { EXPECT_EQ(test::packOf(test::packScene()), test::packOf(test::packScene())); }

TEST(Pack, EveryPuffIsWhereTheSceneHasItAndAsDense) {
  const scene::Scene scene = test::packScene();
  const std::string bytes = test::packOf(scene);
  const check::WrittenScene written = check::readPackScene(bytes, "made.cgpack");
  ASSERT_EQ(written.blobs.size(), scene::drawnPuffs(scene));
  ASSERT_EQ(written.clouds.size(), scene.instances.size());
  for (const scene::Instance& cloud : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[cloud.lit].archetype].puffs) {
      const shape::Puff stands = scene::placed(scene, cloud, shape::widenedAcross(puff));
      const float near = 1e-3f * scene.archetypes[scene.lit[cloud.lit].archetype].widthMeters;
      EXPECT_TRUE(std::any_of(written.blobs.begin(), written.blobs.end(), [&](const check::Blob& blob) {
        return glm::length(blob.center - stands.center) < near &&
               std::abs(static_cast<double>(blob.strength) / shape::extinctionArea(stands) - 1) < 4e-3;
      }));
    }
}

/// Cloud i is there from key i % 3 on, goes east and grows.
scene::Scene movingScene() {
  scene::Scene scene = test::packScene();
  scene.keySeconds = {0, 600, 1200, 3600};
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    scene::Motion motion{i % 3, {}};
    for (std::uint32_t key = motion.firstKey; key < 4; ++key)
      motion.moments.push_back({{100 * static_cast<float>(key), 5, 0}, 1 + 0.1f * static_cast<float>(key),
                                key == motion.firstKey ? 0.0f : 0.8f});
    scene.motions.push_back(motion);
  }
  return scene;
}

TEST(Pack, ASkyThatMovesStandsAsTheSceneAtAnyTime) {
  const scene::Scene scene = movingScene();
  const std::string bytes = test::packOf(scene);
  EXPECT_TRUE(check::validatePack(bytes, "moving.cgpack").valid());
  for (const double seconds : {-5.0, 0.0, 300.0, 600.0, 1000.0, 3000.0, 9000.0}) {
    std::vector<std::pair<float, float>> wanted, written;
    for (const scene::Instance& cloud : scene::instancesAt(scene, seconds))
      if (cloud.opticalDepthFactor > 0) wanted.emplace_back(cloud.position.x, cloud.position.z);
    for (const check::WrittenCloud& cloud : check::readPackScene(bytes, "moving.cgpack", seconds).clouds)
      written.emplace_back(cloud.foot.x, cloud.foot.z);
    std::sort(wanted.begin(), wanted.end());
    std::sort(written.begin(), written.end());
    ASSERT_EQ(written.size(), wanted.size()) << seconds;
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(written[i].first, wanted[i].first, 0.01f) << seconds;
  }
}

TEST(Pack, QuaternionsComeBackWithinAFifthOfADegree) {
  base::RandomStream random(1, 0, base::Purpose::Test);
  for (int i = 0; i < 2000; ++i) {
    const glm::quat turn = glm::angleAxis(static_cast<float>(random.uniform(-7, 7)), glm::vec3(random.direction()));
    const pack::Puff packed(0, 0, 0, 0, 0, 0, packed::smallestThree(turn), 0, 0, 0);
    const glm::quat back = check::unpacked(packed, {}, {}).rotation;
    EXPECT_LT(2 * std::acos(std::min(1.0f, std::abs(glm::dot(turn, back)))), 0.2 * std::numbers::pi / 180);
  }
}

TEST(Pack, ManyCloudsOfFewShapesAreSmall) {
  const std::string bytes = test::packOf(test::wideSky(48, 40, 25'000, 400'000));
  EXPECT_LT(bytes.size() + 600'000, 3'000'000u) << "with real sprites of two genera";
}

}  // namespace
}  // namespace cloudgen::writer
