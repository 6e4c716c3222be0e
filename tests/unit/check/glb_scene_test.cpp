// SPDX-License-Identifier: Apache-2.0
// Scenes of instanced cards, as a viewer of glTF draws them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "check/fidelity/written_scene.hpp"
#include "unit/check/made_glb.hpp"

namespace cloudgen::check::test {
namespace {

using nlohmann::json;

/// One mesh of one level card of 44 x 22 m, a grid of 2 x 1 cells, twice instanced.
struct CardScene {
  json document = json::parse(
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":1},{"mesh":0,"translation":[1000,500,-2000],
        "extras":{"genus":"Sc","clouds":["7","8"]}}],
      "images":[{"name":"Sc","mimeType":"image/png"}],"textures":[{"source":0}],
      "materials":[{"alphaMode":"BLEND","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},{}],
      "meshes":[{"primitives":[{"attributes":{},"material":0}]},{"primitives":[{"attributes":{},"material":1}]}],
      "buffers":[{}]})");
  std::vector<float> points{-22, 0, 11, 0, 0, 11, 22, 0, 11, -22, 0, -11, 0, 0, -11, 22, 0, -11},
      places{0.25f, 0.5f, 0.375f, 0.5f, 0.5f, 0.5f, 0.25f, 0.25f, 0.375f, 0.25f, 0.5f, 0.25f},
      shifts{0, 0, 0, 100, 50, 0}, scales{1, 1, 1, 2, 2, 2},
      turns{0, 0, 0, 1, 0, std::sqrt(0.5f), 0, std::sqrt(0.5f)};
  std::vector<std::uint16_t> colors;
  std::vector<float> verticalOpticalDepths;
  std::vector<std::uint32_t> triangles{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};

  explicit CardScene(double alpha = 0.5) {
    for (int i = 0; i < 6; ++i)
      colors.insert(colors.end(), {65535, 65535, 65535, static_cast<std::uint16_t>(65535 * alpha)});
  }

  std::string bytes() const {
    MadeGlb glb{document, {}};
    json& primitive = glb.document["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", glb.column(points, "VEC3", 3)},
                               {"TEXCOORD_0", glb.column(places, "VEC2", 2)},
                               {"COLOR_0", glb.column(colors, "VEC4", 4)}};
    if (!verticalOpticalDepths.empty())
      primitive["attributes"]["_VERTICAL_OPTICAL_DEPTH"] = glb.column(verticalOpticalDepths, "SCALAR", 1);
    primitive["indices"] = glb.column(triangles, "SCALAR", 1);
    glb.document["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", glb.column(shifts, "VEC3", 3)},
        {"ROTATION", glb.column(turns, "VEC4", 4)},
        {"SCALE", glb.column(scales, "VEC3", 3)}};
    return glb.bytes();
  }
  WrittenScene read() const { return readGlbScene(bytes(), "made.glb"); }
  std::vector<Footprint> seen() const {
    const WrittenScene scene = read();
    return footprintsOf(scene.blobs, scene.pivots, {});
  }
};

TEST(GlbScene, EveryInstanceShowsTheCardsOfItsMesh) {
  const auto seen = CardScene().seen();
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_FLOAT_EQ(seen[0].place.x, 1000);
  EXPECT_FLOAT_EQ(seen[0].place.y, -2000);
  EXPECT_FLOAT_EQ(seen[0].height, 500);
  EXPECT_NEAR(seen[0].halfSides().x, 22, 1e-3);
  EXPECT_NEAR(seen[0].halfSides().y, 11, 1e-3);
  EXPECT_NEAR(seen[0].opticalDepth, std::log(2.0), 1e-4);
  // The other one is twice as large and turned by a quarter.
  EXPECT_FLOAT_EQ(seen[1].place.x, 1100);
  EXPECT_FLOAT_EQ(seen[1].height, 550);
  EXPECT_NEAR(seen[1].halfSides().x, 22, 1e-2);
  EXPECT_NEAR(seen[1].halfSides().y, 44, 1e-2);
}

TEST(GlbScene, AReliefHasACardACellThatHoldsWhatItStates) {
  CardScene made;
  made.triangles = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  made.verticalOpticalDepths = std::vector<float>(6, 3);
  made.document["materials"][0]["doubleSided"] = false;
  const WrittenScene scene = made.read();
  ASSERT_EQ(scene.blobs.size(), 4u);
  double held = 0;
  for (std::size_t i = 0; i < 2; ++i)
    held += 2 * std::numbers::pi * kWithinCard *
            static_cast<double>(scene.blobs[i].strength *
                                std::abs(glm::cross(scene.blobs[i].right(), scene.blobs[i].up()).y));
  EXPECT_NEAR(held, 3 * 44 * 22, 3) << "whatever the spread within a cell";
  EXPECT_NEAR(scene.blobs[0].center.x, 989, 1e-3);
  EXPECT_TRUE(scene.blobs[0].front && scene.blobs[0].back) << "a column meets both sides of a cloud";
  std::swap(made.triangles[3], made.triangles[4]);
  EXPECT_THROW(made.read(), base::InputError);
}

TEST(GlbScene, AScaledNodeScalesItsInstances) {
  CardScene made;
  made.document["nodes"][1]["scale"] = {2, 2, 2};
  const auto seen = made.seen();
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_NEAR(seen[0].halfSides().x, 44, 1e-3);
  EXPECT_FLOAT_EQ(seen[1].place.x, 1200);
}

TEST(GlbScene, InstancesAreCloudsWithTheirGenus) {
  CardScene made;
  WrittenScene scene = made.read();
  ASSERT_EQ(scene.clouds.size(), 2u);
  EXPECT_EQ(scene.clouds[1].recorded, base::Genus::Stratocumulus);
  EXPECT_EQ(scene.clouds[1].drawn, base::Genus::Stratocumulus);
  EXPECT_FLOAT_EQ(scene.clouds[1].foot.y, 550);
  made.document["images"][0]["name"] = "Ci";
  EXPECT_EQ(made.read().clouds[0].drawn, base::Genus::Cirrus);
}

TEST(GlbScene, OneSidedCardsShowTheSideOfTheirTriangles) {
  CardScene made;
  made.document["materials"][0]["doubleSided"] = false;
  EXPECT_EQ(made.seen().size(), 2u);
  for (std::size_t t = 0; t < made.triangles.size(); t += 3)
    std::swap(made.triangles[t], made.triangles[t + 1]);
  EXPECT_EQ(made.seen().size(), 0u);
}

TEST(GlbScene, OpaqueCardsHideHowDenseTheyAre) {
  EXPECT_EQ(CardScene(1).read().saturated, 2u);
  EXPECT_EQ(CardScene(0.9).read().saturated, 0u);
}

TEST(GlbScene, RefusesWhatItCannotRead) {
  const auto refused = [](const auto& change) {
    CardScene made;
    change(made);
    EXPECT_THROW(made.read(), base::InputError);
  };
  refused([](CardScene& made) { made.triangles[3] = 6; });
  refused([](CardScene& made) { made.places.resize(10); });
  refused([](CardScene& made) { made.turns.resize(4); });
  refused([](CardScene& made) { made.document["nodes"][1]["matrix"] = json::array({2}); });
  refused([](CardScene& made) { made.document["meshes"][0]["primitives"][0]["material"] = 5; });
  const std::string whole = CardScene().bytes();
  for (std::size_t length = 0; length < whole.size(); length += 31)
    EXPECT_THROW(readGlbScene(std::string_view(whole).substr(0, length), "cut.glb"), base::InputError)
        << length;
}

}  // namespace
}  // namespace cloudgen::check::test
