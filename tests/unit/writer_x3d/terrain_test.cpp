// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/file.hpp"
#include "support/scratch.hpp"
#include "support/small_scene.hpp"
#include "writer/x3d/ground.hpp"
#include "writer/x3d/viewpoints.hpp"

namespace cloudgen::writer {
namespace {

/// A pyramid of 1500 m over a ground of 400 m, as high as the scene's rectangle is wide.
scene::Scene sceneWithMountain() {
  scene::Scene scene = test::sceneOf({}, 0);
  const glm::dvec2 lower = scene.frame.lowerCorner(), upper = scene.frame.upperCorner();
  scene.terrain = {5, 5, lower, 0.25 * (upper - lower), std::vector<float>(25, 400)};
  scene.terrain.heights[12] = 1500;
  return scene;
}

std::string groundOf(const scene::Scene& scene, Encoding encoding) {
  const test::Scratch folder;
  const auto file = folder.path() / "terrain_test.txt";
  const auto nodes = nodeWriter(encoding, file);
  nodes->start({{"title", "ground"}});
  writeGround(*nodes, scene, stageOf(scene));
  nodes->finish();
  return base::readFile(file);
}

/// X3DOM's package knows no ElevationGrid.
TEST(Terrain, IsFacesInEveryEncoding) {
  const scene::Scene scene = sceneWithMountain();
  for (const Encoding encoding : {Encoding::Xml, Encoding::Classic, Encoding::Vrml97}) {
    const std::string text = groundOf(scene, encoding);
    EXPECT_EQ(text.find("ElevationGrid"), std::string::npos);
    EXPECT_NE(text.find("Ground"), std::string::npos);
    const std::string terrain = text.substr(text.find("Terrain"));
    EXPECT_NE(terrain.find("0 5 6 1 -1"), std::string::npos);
    EXPECT_NE(terrain.find("18 23 24 19 -1"), std::string::npos);
    EXPECT_NE(terrain.find(" 1500 "), std::string::npos);
  }
}

TEST(Terrain, ShadowsOfCloudsLieOnTheGround) {
  scene::Scene scene = test::sceneOf({}, 0);
  const std::string sunny = groundOf(scene, Encoding::Xml);
  const glm::dvec2 middle = 0.5 * (scene.frame.lowerCorner() + scene.frame.upperCorner());
  const light::Caster cloud{glm::vec3(middle.x, 1000, middle.y), 5000, 500, 20};
  scene.shadows = light::shadowsOf(std::span(&cloud, 1), {0, 1, 0}).whole;
  const std::string shaded = groundOf(scene, Encoding::Xml);
  EXPECT_NE(shaded, sunny);
  EXPECT_LT(std::abs(static_cast<long>(shaded.size()) - static_cast<long>(sunny.size())), 20'000);
}

TEST(Terrain, NoEyeIsUnderTheGround) {
  const scene::Scene scene = sceneWithMountain();
  for (const View& view : viewsOf(scene, stageOf(scene)))
    EXPECT_GT(view.eye.y, scene::groundAt(scene, view.eye.x, view.eye.z)) << view.name;
}

}  // namespace
}  // namespace cloudgen::writer
