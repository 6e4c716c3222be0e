// SPDX-License-Identifier: Apache-2.0
// The reader of written splats is a second opinion: it must see what the scene holds.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/gltf/read_splats.hpp"
#include "check/gltf/validate_glb.hpp"
#include "support/gltf_scene.hpp"
#include "support/scratch.hpp"
#include "writer/gltf/gltf.hpp"

namespace cloudgen::writer {
namespace {

TEST(ReadBack, SeesEveryPuffWhereTheSceneHasIt) {
  scene::Scene scene = test::gltfScene();
  scene.archetypes[0].puffs[0].extinctionPerMeter = 2;  // far denser than an opacity can tell
  const test::Scratch folder;
  writeSplats(scene, {folder.path(), {}});
  const check::SplatFile file = check::readSplats(folder.path() / "scene.splats.glb");

  std::vector<shape::Puff> expected;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[instance.lit].archetype].puffs) {
      const shape::Puff placed = scene::placed(scene, instance, puff);
      if (-std::expm1(-shape::frontalOpticalDepth(placed)) >= 0.004f) expected.push_back(placed);
    }
  ASSERT_EQ(file.splats.size(), expected.size());
  // A splat may be wider than its puff, but holds as much.
  const auto heldBy = [](const check::ReadSplat& splat) {
    const glm::vec3& s = splat.sigma;
    return 2 * std::numbers::pi * splat.opticalDepth * s.x * s.y * s.z / std::min({s.x, s.y, s.z});
  };
  for (const shape::Puff& puff : expected)
    EXPECT_TRUE(std::any_of(file.splats.begin(), file.splats.end(), [&](const check::ReadSplat& splat) {
      return glm::length(splat.center - puff.center) < 0.05f &&
             std::abs(heldBy(splat) / shape::extinctionArea(puff) - 1) < 1e-3;
    }));
  EXPECT_NEAR(file.sunElevationDegrees, scene.sun.elevationDegrees, 1e-9);
}

TEST(ReadBack, QuantizedSplatsAreTheSameInHalfTheBytes) {
  scene::Scene scene = test::gltfScene(400);
  scene.archetypes[0].puffs[0].extinctionPerMeter = 2;
  const test::Scratch full, small;
  for (const int degree : {0, 1}) {
    writeSplats(scene, {.folder = full.path(), .splats = {degree, false}});
    writeSplats(scene, {.folder = small.path(), .splats = {degree, true}});
    const auto file = [](const test::Scratch& folder) { return folder.path() / "scene.splats.glb"; };
    const auto wanted = check::readSplats(file(full)).splats, read = check::readSplats(file(small)).splats;
    ASSERT_EQ(read.size(), wanted.size());
    EXPECT_LT(std::filesystem::file_size(file(small)), read.size() * (32 + 36 * static_cast<std::size_t>(degree)) + 20'000);
    double held = 0, expected = 0;
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_LT(glm::distance(read[i].center, wanted[i].center), 0.5f);
      EXPECT_LT(glm::distance(read[i].sigma, wanted[i].sigma), 0.5f);
      EXPECT_GT(std::abs(glm::dot(glm::normalize(read[i].rotation), wanted[i].rotation)), 0.9999f);
      EXPECT_NEAR(read[i].opacity, wanted[i].opacity, 1e-5);
      EXPECT_NEAR(read[i].opticalDepth / wanted[i].opticalDepth, 1, 0.02);
      EXPECT_EQ(read[i].color, wanted[i].color);
      EXPECT_EQ(read[i].harmonics, wanted[i].harmonics);
      held += static_cast<double>(read[i].opticalDepth * read[i].sigma.x * read[i].sigma.z);
      expected += static_cast<double>(wanted[i].opticalDepth * wanted[i].sigma.x * wanted[i].sigma.z);
    }
    EXPECT_NEAR(held / expected, 1, 1e-3);
    const auto findings = check::validateGlb(file(small), {}, {}).findings;
    EXPECT_TRUE(findings.empty()) << check::text(findings.front());
  }
}

TEST(ReadBack, ReliefsOfCloudsHoldWhatTheirPuffsHold) {
  scene::Scene scene = test::gltfScene();
  for (shape::Puff& puff : scene.archetypes[0].puffs)
    puff.extinctionPerMeter *= 50;  // far denser than opacities tell
  const test::Scratch folder;
  writeCards(scene, {folder.path(), {}});
  const check::WrittenScene read = check::readGlbScene(folder.path() / "scene.glb");
  EXPECT_EQ(read.saturated, 0u);
  double held = 0, expected = 0;
  for (const check::Blob& blob : read.blobs)
    held += 2 * std::numbers::pi * check::kWithinCard *
            static_cast<double>(blob.strength * std::abs(glm::cross(blob.right(), blob.up()).y));
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[instance.lit].archetype].puffs)
      expected += shape::extinctionArea(scene::placed(scene, instance, puff));
  EXPECT_NEAR(held / expected, 1, 0.02);
}

TEST(ReadBack, ReliefsOfCloudsReachFromBaseToTop) {
  const scene::Scene scene = test::gltfScene();
  const test::Scratch folder;
  writeCards(scene, {folder.path(), {}});
  const check::WrittenScene read = check::readGlbScene(folder.path() / "scene.glb");
  float lowest = 1e9f, highest = -1e9f;
  for (const check::Blob& blob : read.blobs)
    if (blob.strength > 1)
      lowest = std::min(lowest, blob.center.y), highest = std::max(highest, blob.center.y);
  double base = 1e9, top = -1e9;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[0].puffs) {
      if (scene.lit[instance.lit].archetype != 0) continue;
      base = std::min(base, static_cast<double>(scene::placed(scene, instance, puff).center.y));
      top = std::max(top, static_cast<double>(scene::placed(scene, instance, puff).center.y));
    }
  EXPECT_NEAR(lowest, base, 150);
  EXPECT_NEAR(highest, top, 150);
}

TEST(ReadBack, CloudsAsNodesStandWhereInstancesDo) {
  const scene::Scene scene = test::gltfScene();
  const test::Scratch instanced, singly;
  writeCards(scene, {instanced.path(), {}});
  writeCards(scene, {.folder = singly.path(), .cards = {true}});
  const auto a = check::readGlbScene(instanced.path() / "scene.glb"),
             b = check::readGlbScene(singly.path() / "scene.glb");
  ASSERT_EQ(a.blobs.size(), b.blobs.size());
  ASSERT_EQ(b.clouds.size(), scene.instances.size());
  for (std::size_t i = 0; i < a.blobs.size(); ++i) {
    EXPECT_LT(glm::distance(a.blobs[i].center, b.blobs[i].center), 0.01f);
    EXPECT_LT(glm::distance(a.blobs[i].right(), b.blobs[i].right()), 0.01f);
    EXPECT_EQ(a.blobs[i].strength, b.blobs[i].strength);
  }
  EXPECT_EQ(base::readFile(singly.path() / "scene.glb").find("gpu_instancing"), std::string::npos);
}

TEST(ReadBack, RefusesWhatIsCutShort) {
  const scene::Scene scene = test::gltfScene();
  const test::Scratch folder;
  writeSplats(scene, {folder.path(), {}});
  const std::string whole = base::readFile(folder.path() / "scene.splats.glb");
  for (int part = 0; part < 50; ++part)
    EXPECT_THROW(
        check::readSplats(whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 50), "cut.glb"),
        base::InputError);
}

}  // namespace
}  // namespace cloudgen::writer
