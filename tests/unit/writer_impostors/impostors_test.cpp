// SPDX-License-Identifier: Apache-2.0
#include "writer/impostors/impostors.hpp"

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "cli/fits_schema.hpp"
#include "support/read_png.hpp"
#include "support/scratch.hpp"
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

class Impostors : public testing::Test {
 protected:
  void SetUp() override {
    writeImpostors(scene, {folder.path(), {}});
    file = nlohmann::json::parse(base::readFile(folder.path() / "impostors.json"));
  }

  const scene::Scene scene = test::smallScene();
  test::Scratch folder;
  nlohmann::json file;
};

TEST_F(Impostors, FitTheirSchema) { test::expectFitsSchema(file, "impostors.schema.json"); }

TEST_F(Impostors, EveryCloudHasAnAtlasOfItsShapeAndHeading) {
  ASSERT_EQ(file["clouds"].size(), scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::LitArchetype& lit = scene.lit[scene.instances[i].lit];
    const auto& atlas = file["atlases"].at(file["clouds"][i]["atlas"].get<std::size_t>());
    EXPECT_EQ(atlas["archetype"], scene.archetypes[lit.archetype].name);
    EXPECT_NEAR(atlas["heading_degrees"].get<double>() / 360 * scene::kYawSteps, lit.yawStep, 1e-9);
  }
}

// No edge of a quad is seen, and what is seen lies in the sphere.
TEST_F(Impostors, PicturesEndTransparentAndHaveDepthWhereTheyAreSeen) {
  const int tile = file["tile_pixels"], side = tile * file["views_across"].get<int>();
  for (const auto& atlas : file["atlases"]) {
    const image::ByteImage color = test::readPng(folder.path() / atlas["color"].get<std::string>()),
                           depth = test::readPng(folder.path() / atlas["depth"].get<std::string>());
    ASSERT_EQ(color.channels, 4);
    ASSERT_EQ(depth.channels, 1);
    ASSERT_TRUE(color.width == side && depth.width == side && color.height == side && depth.height == side);
    int opaquest = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const auto at = static_cast<std::size_t>(y * side + x);
        const int alpha = color.bytes[4 * at + 3];
        opaquest = std::max(opaquest, alpha);
        const bool border = x % tile == 0 || x % tile == tile - 1 || y % tile == 0 || y % tile == tile - 1;
        ASSERT_TRUE(!border || alpha == 0) << x << ' ' << y;
        if (alpha > 10) {
          ASSERT_LT(depth.bytes[at], 255);
          ASSERT_GT(color.bytes[4 * at], 20);
        }
      }
    EXPECT_GT(opaquest, 40);
  }
}

}  // namespace
}  // namespace cloudgen::writer
