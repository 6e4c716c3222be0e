// SPDX-License-Identifier: Apache-2.0
// What splat tools read of a PLY file, by a reader that shares no code with the writer.
#include "writer/ply/ply.hpp"

#include <fmt/format.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/ply/read_ply.hpp"
#include "check/ply/validate_ply.hpp"
#include "support/gltf_scene.hpp"
#include "support/scratch.hpp"
#include "writer/gltf/gltf.hpp"

namespace cloudgen::writer {
namespace {

std::string written(const scene::Scene& scene, int degree) {
  const test::Scratch folder;
  writePly(scene, {.folder = folder.path(), .splats = {degree}});
  return base::readFile(folder.path() / "scene.splats.ply");
}

std::vector<check::ReadSplat> splatsOf(const std::string& bytes) {
  std::vector<check::ReadSplat> splats;
  check::readPlySplats(bytes, "test.ply", [&](const check::ReadSplat& splat) { splats.push_back(splat); });
  return splats;
}

TEST(Ply, HoldsTheSplatsOfTheGlb) {
  scene::Scene scene = test::gltfScene();
  scene.archetypes[0].puffs[0].extinctionPerMeter = 2;  // far denser than an opacity can tell
  const test::Scratch folder;
  writeSplats(scene, {folder.path(), {}});
  const auto expected = check::readSplats(folder.path() / "scene.splats.glb").splats;
  for (const int degree : {0, 1, 2}) {
    const std::string bytes = written(scene, degree);
    EXPECT_TRUE(check::validatePlyBytes(bytes, "test.ply").findings.empty()) << degree;
    const auto splats = splatsOf(bytes);
    ASSERT_EQ(splats.size(), expected.size());
    for (std::size_t i = 0; i < splats.size(); ++i) {
      EXPECT_LT(glm::distance(splats[i].center, expected[i].center), 0.01f);
      EXPECT_LT(glm::distance(splats[i].sigma, expected[i].sigma), 1e-4f * expected[i].sigma.x);
      EXPECT_GT(std::abs(glm::dot(splats[i].rotation, expected[i].rotation)), 0.99999f);
      EXPECT_NEAR(splats[i].opticalDepth / expected[i].opticalDepth, 1, 1e-4);
      EXPECT_NEAR(splats[i].opacity, expected[i].opacity, 1e-5);
      EXPECT_LT(glm::distance(splats[i].color, expected[i].color), 1e-5f);
      const glm::vec3 harmonic = degree > 0 ? expected[i].harmonics[2] : glm::vec3(0);
      EXPECT_LT(glm::distance(splats[i].harmonics[2], harmonic), 1e-5f);
    }
  }
}

TEST(Ply, NamesWhatSplatToolsLookFor) {
  const std::string bytes = written(test::gltfScene(10, 1), 1);
  const std::string header = bytes.substr(0, bytes.find("end_header"));
  EXPECT_TRUE(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
  for (const char* name : {"x", "f_dc_2", "f_rest_8", "opacity", "scale_2", "rot_3"})
    EXPECT_NE(header.find(fmt::format("property float {}\n", name)), std::string::npos) << name;
  EXPECT_EQ(header.find("f_rest_9"), std::string::npos);
}

TEST(Ply, NoCloudsAreNoSplatsAndTheSameSceneIsTheSameBytes) {
  EXPECT_TRUE(splatsOf(written({.frame = base::LocalFrame({0, 0, 1, 1})}, 1)).empty());
  EXPECT_EQ(written(test::gltfScene(), 1), written(test::gltfScene(), 1));
}

TEST(Ply, BrokenFilesAreFoundOut) {
  const std::string good = written(test::gltfScene(10, 1), 1);
  const auto rulesOf = [](const std::string& bytes) {
    std::string rules;
    for (const check::Finding& finding : check::validatePlyBytes(bytes, "test.ply").findings)
      rules += finding.rule + " ";
    return rules;
  };
  EXPECT_EQ(rulesOf(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string broken = good;
    return broken.replace(broken.find(from), from.size(), to);
  };
  EXPECT_EQ(rulesOf(good.substr(0, good.size() - 4)), "ply-header ");
  EXPECT_EQ(rulesOf(with("ply\n", "plx\n")), "ply-header ");
  EXPECT_EQ(rulesOf(with("little", "big")), "ply-header ");
  EXPECT_EQ(rulesOf(with("property float opacity", "property double opacity")), "ply-header ");
  EXPECT_EQ(rulesOf(with("scale_0", "scale_4")), "ply-header ");
  EXPECT_EQ(rulesOf(with("f_rest_8", "f_rest_9")), "ply-header ");
  EXPECT_EQ(rulesOf(with("rot_1", "rot_2")), "ply-header ");
  EXPECT_EQ(rulesOf(with("element vertex", "element face")), "ply-header ");
  EXPECT_EQ(rulesOf(with("end_header", "end_hea")), "ply-header ");
  std::string infinite = good;
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + infinite.size() - 5 * sizeof(float), &infinity, sizeof infinity);  // scale_2
  EXPECT_EQ(rulesOf(infinite), "ply-splats ");
  std::memset(infinite.data() + infinite.size() - 4 * sizeof(float), 0, 4 * sizeof(float));  // rotation
  EXPECT_EQ(rulesOf(infinite), "ply-splats ");
}

TEST(Ply, IsReadAsASceneToVerify) {
  const test::Scratch folder;
  const scene::Scene scene = test::gltfScene();
  writePly(scene, {folder.path(), {}});
  writeSplats(scene, {folder.path(), {}});
  const auto ply = check::readPlyScene(folder.path() / "scene.splats.ply"),
             glb = check::readSplatScene(folder.path() / "scene.splats.glb");
  ASSERT_EQ(ply.blobs.size(), glb.blobs.size());
  double held = 0, expected = 0;
  for (std::size_t i = 0; i < ply.blobs.size(); ++i)
    held += static_cast<double>(ply.blobs[i].strength), expected += static_cast<double>(glb.blobs[i].strength);
  EXPECT_NEAR(held / expected, 1, 1e-5);
}

}  // namespace
}  // namespace cloudgen::writer
