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

int alphaAt(const image::ByteImage& image, int x, int y) {
  return image.bytes[4 * static_cast<std::size_t>(y * image.width + x) + 3];
}

TEST(Sheets, CoverTheGroundThatThePuffsDo) {
  const scene::Scene scene = test::smallScene();
  const PuffPicture sheet = sheetOfAll(scene).picture;
  std::vector<shape::Puff> puffs;
  for (const scene::Instance& instance : scene.instances)
    for (const shape::Puff& puff : scene.archetypes[scene.lit[instance.lit].archetype].puffs)
      puffs.push_back(scene::placed(scene, instance, puff));
  int covered = 0;
  const double covering = 255 * -std::expm1(-shape::kCoveringOpticalDepth);
  for (int y = 0; y < sheet.image.height; ++y)
    for (int x = 0; x < sheet.image.width; ++x) covered += alphaAt(sheet.image, x, y) > covering;
  const glm::dvec2 step =
      glm::dvec2(sheet.upper - sheet.lower) / glm::dvec2(sheet.image.width, sheet.image.height);
  const double wanted = shape::coveredSquareMeters(puffs);
  EXPECT_NEAR(covered * step.x * step.y, wanted, 0.02 * wanted);
}

TEST(Sheets, ArePatchedWhereSomethingIsSeenAndFadeToTheirBorder) {
  const scene::Scene scene = test::smallScene();
  const Sheet sheet = sheetOfAll(scene);
  const image::ByteImage& image = sheet.picture.image;
  std::vector<int> patched(static_cast<std::size_t>(image.width * image.height), 0);
  for (const glm::ivec4& patch : sheet.patches)
    for (int y = patch.y; y < patch.w; ++y)
      for (int x = patch.x; x < patch.z; ++x) ++patched[static_cast<std::size_t>(y * image.width + x)];
  int seen = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int patches = patched[static_cast<std::size_t>(y * image.width + x)];
      ASSERT_LE(patches, 1);
      if (alphaAt(image, x, y) < kSeenAlpha) continue;
      ++seen;
      ASSERT_EQ(patches, 1) << x << ' ' << y;
      ASSERT_TRUE(x > 0 && y > 0 && x < image.width - 1 && y < image.height - 1);
    }
  EXPECT_GT(seen, kPixels);
}

TEST(Sheets, OfAnAtlasLieWhereTheirCloudsDo) {
  const scene::Scene scene = test::smallScene();
  const Sheet sheet = sheetOfAll(scene);
  const PuffPicture& picture = sheet.picture;
  const image::ByteImage small{10, 300, 4, std::vector<unsigned char>(4 * 10 * 300)};
  const std::vector<const image::ByteImage*> images{&picture.image, &small};
  const PictureAtlas atlas(images);
  const QuadMesh mesh = meshOf(sheet, atlas, 0);
  ASSERT_EQ(mesh.quads.size(), sheet.patches.size());
  EXPECT_EQ(mesh.faces.size(), 2 * mesh.quads.size());
  const glm::vec2 texture(atlas.texture().width, atlas.texture().height);
  for (const Quad& quad : mesh.quads) {
    EXPECT_GT(glm::cross(quad.right, quad.up).y, 0);              // the front looks up
    const glm::vec3 corner = quad.center - quad.right + quad.up;  // in the north-west
    const glm::vec2 share{(corner.x - picture.lower.x) / (picture.upper.x - picture.lower.x),
                          (corner.z + picture.upper.y) / (picture.upper.y - picture.lower.y)};
    // The higher picture comes first.
    EXPECT_NEAR(quad.textureBox.x * texture.x, 10 + share.x * static_cast<float>(picture.image.width), 0.1);
    EXPECT_NEAR((1 - quad.textureBox.w) * texture.y, share.y * static_cast<float>(picture.image.height), 0.1);
  }
}

}  // namespace
}  // namespace cloudgen::writer
