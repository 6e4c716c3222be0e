// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/sheets.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "shape/blending.hpp"
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

constexpr int kPixels = 256;

Sheet sheetOfAll(const scene::Scene& scene) {
  std::vector<std::uint32_t> all(scene.instances.size());
  std::iota(all.begin(), all.end(), 0u);
  return sheetOf(scene, all, kPixels);
}

int alphaAt(const Sheet& sheet, int x, int y) {
  return sheet.picture.bytes[4 * static_cast<std::size_t>(y * kPixels + x) + 3];
}

TEST(Sheets, CoverTheGroundThatThePuffsDo) {
  scene::Scene scene = test::smallScene();
  const Sheet sheet = sheetOfAll(scene);
  std::vector<shape::Puff> puffs;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[instance.lit].archetype].farPuffs)
      puffs.push_back(scene::placed(scene, instance, puff));
  int covered = 0;
  const double covering = 255 * -std::expm1(-shape::kCoveringOpticalDepth);
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) covered += alphaAt(sheet, x, y) > covering;
  const glm::dvec2 step = glm::dvec2(sheet.upper - sheet.lower) / static_cast<double>(kPixels);
  const double wanted = shape::coveredSquareMeters(puffs);
  EXPECT_NEAR(covered * step.x * step.y, wanted, 0.02 * wanted);
}

TEST(Sheets, AreEmptyAtTheBorderAndPatchedWhereSomethingIsSeen) {
  const scene::Scene scene = test::smallScene();
  const Sheet sheet = sheetOfAll(scene);
  std::vector<int> patched(kPixels * kPixels, 0);
  for (const glm::ivec4& patch : sheet.patches)
    for (int y = patch.y; y < patch.w; ++y)
      for (int x = patch.x; x < patch.z; ++x) ++patched[static_cast<std::size_t>(y * kPixels + x)];
  int seen = 0;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) {
      const int patches = patched[static_cast<std::size_t>(y * kPixels + x)];
      ASSERT_LE(patches, 1);
      if (alphaAt(sheet, x, y) < 2) continue;
      ++seen;
      ASSERT_EQ(patches, 1) << x << ' ' << y;
      ASSERT_TRUE(x > 0 && y > 0 && x < kPixels - 1 && y < kPixels - 1);
    }
  EXPECT_GT(seen, kPixels);
}

TEST(Sheets, OfAnAtlasLieWhereTheirCloudsDo) {
  const scene::Scene scene = test::smallScene();
  const std::vector<Sheet> sheets(5, sheetOfAll(scene));
  const SheetAtlas atlas(sheets, kPixels);
  EXPECT_EQ(atlas.texture().width, 3 * kPixels);
  EXPECT_EQ(atlas.texture().height, 2 * kPixels);
  const QuadMesh mesh = atlas.meshOf(sheets[4], 4);
  ASSERT_EQ(mesh.quads.size(), sheets[4].patches.size());
  EXPECT_EQ(mesh.faces.size(), 2 * mesh.quads.size());
  for (const Quad& quad : mesh.quads) {
    EXPECT_GT(glm::cross(quad.right, quad.up).y, 0);  // the front looks up
    for (const float sign : {-1.0f, 1.0f}) {
      const glm::vec3 corner = quad.center + sign * (quad.right + quad.up);
      const glm::vec2 share =
          (glm::vec2(corner.x, corner.z) - sheets[4].lower) / (sheets[4].upper - sheets[4].lower);
      const float u = sign < 0 ? quad.textureBox.x : quad.textureBox.z,
                  v = sign < 0 ? quad.textureBox.y : quad.textureBox.w;
      // The fifth lies in the middle of the second row.
      EXPECT_NEAR(u, (1 + share.x) / 3, 1e-4);
      EXPECT_NEAR(1 - v, (1 + share.y) / 2, 1e-4);
    }
  }
}

}  // namespace
}  // namespace cloudgen::writer
