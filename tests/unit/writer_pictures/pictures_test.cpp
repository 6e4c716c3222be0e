// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "support/all_recipes.hpp"
#include "support/small_scene.hpp"
#include "support/usual_cloud.hpp"
#include "writer/pictures/cloud_pictures.hpp"
#include "writer/pictures/picture_atlas.hpp"

namespace cloudgen::writer {
namespace {

double meanAlpha(const PuffPicture& picture) {
  double sum = 0;
  for (std::size_t i = 3; i < picture.image.bytes.size(); i += 4) sum += picture.image.bytes[i] / 255.0;
  return 4 * sum / static_cast<double>(picture.image.bytes.size());
}

ColoredPuff threadAlong(float degrees) {
  ColoredPuff thread;
  thread.puff.sigma = {2000, 60, 60};
  thread.puff.rotation = glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0));
  thread.puff.extinctionPerMeter = 0.01f;
  return thread;
}

TEST(Pictures, OfThreadsAreStreaksAndNoDiscs) {
  const std::vector<ColoredPuff> threads{threadAlong(45)};
  const PuffPicture picture = paintedPuffs(threads, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 64);
  EXPECT_LT(meanAlpha(picture), 0.2);  // a disc would fill three quarters of its square
}

TEST(Pictures, ShowTheNearPuffBeforeTheFarOne) {
  std::vector<ColoredPuff> puffs(2);
  for (ColoredPuff& puff : puffs) puff.puff.sigma = glm::vec3(100), puff.puff.extinctionPerMeter = 0.1f;
  puffs[0].puff.center.z = 500, puffs[0].color = {1, 0, 0};
  puffs[1].puff.center.z = -500, puffs[1].color = {0, 0, 1};
  const PuffPicture south = paintedPuffs(puffs, kFromSouth, 64),
                    north = paintedPuffs(puffs, {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, 64);
  const auto middle = [](const image::ByteImage& image) {
    return 4 * static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2);
  };
  EXPECT_GT(south.image.bytes[middle(south.image)], 250);
  EXPECT_GT(north.image.bytes[middle(north.image) + 2], 250);
  EXPECT_NEAR(south.surface, 450, 150);
  EXPECT_NEAR(north.surface, 450, 150);
}

TEST(Pictures, HaveTheReliefOfWhatTheyShow) {
  std::vector<ColoredPuff> puffs(2);
  for (ColoredPuff& puff : puffs) puff.puff.sigma = glm::vec3(100), puff.puff.extinctionPerMeter = 0.1f;
  puffs[0].puff.center = {-400, 0, 300};
  puffs[1].puff.center = {400, 0, -300};
  const PuffPicture picture = paintedPuffs(puffs, kFromSouth, 0.1f, 12);
  const Relief& relief = picture.relief;
  EXPECT_EQ(std::max(relief.columns, relief.rows), 12);
  const int middle = relief.rows / 2;
  EXPECT_NEAR(relief.nearness[relief.vertex(1, middle)], 300, 60);
  EXPECT_NEAR(relief.nearness[relief.vertex(relief.columns - 1, middle)], -300, 60);
  const glm::dvec2 cell = glm::dvec2(picture.upper - picture.lower) / glm::dvec2(relief.columns, relief.rows);
  double held = 0;
  for (const auto& [column, row] : relief.shown)
    for (const auto& [right, down] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      held += 0.25 * cell.x * cell.y *
              static_cast<double>(relief.opticalDepth[relief.vertex(column + right, row + down)]);
  EXPECT_NEAR(held / (shape::extinctionArea(puffs[0].puff) + shape::extinctionArea(puffs[1].puff)), 1, 0.03);
}

/// Of what is seen of a picture, sRGB.
glm::dvec3 meanColor(const image::ByteImage& image) {
  glm::dvec3 sum(0);
  double alpha = 0;
  for (std::size_t i = 0; i < image.bytes.size(); i += 4) {
    sum += image.bytes[i + 3] / 255.0 * glm::dvec3(image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]) /
           255.0;
    alpha += image.bytes[i + 3] / 255.0;
  }
  return sum / alpha;
}

/// The most that a picture has along its border.
double borderAlpha(const image::ByteImage& image) {
  int most = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1)
        most = std::max<int>(most, image.bytes[static_cast<std::size_t>(4 * (y * image.width + x) + 3)]);
  return most / 255.0;
}

// Or their quads would be seen.
TEST(Pictures, OfEveryGenusEndTransparent) {
  for (const base::Genus genus : base::allGenera()) {
    std::vector<ColoredPuff> puffs;
    const shape::Recipe recipe = test::recipeOf(genus);
    for (const shape::Puff& puff : shape::generate(recipe, test::usualCloud(recipe, 300, 8)).puffs) puffs.push_back({puff});
    for (const Sight& sight : {kFromSouth, Sight{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}})
      EXPECT_LT(borderAlpha(paintedPuffs(puffs, sight, 64).image), 0.05) << base::name(genus) << ' ' << sight.towards.y;
  }
}

TEST(Pictures, AreAsBrightAsThePuffsTheyStandFor) {
  scene::Scene scene = test::smallScene();
  const light::PuffLight light{{0.4f, 0.45f, 0.5f}, 0.3f};
  for (light::PuffLight& puff : scene.lit[0].puffs) puff = light;
  const light::EncodedLight shown = light::encoded(light, scene.sun.color);
  const CloudPictures cloud = picturesOf(scene, 0, 64);
  const NearPictures near = nearPicturesOf(scene, 0, 64);
  ASSERT_EQ(near.pictures.size(), 1u);
  EXPECT_LT(glm::distance(meanColor(near.pictures[0].picture.image), glm::dvec3(shown.mean)), 0.01);
  // What looks towards the sun sees more of the light that goes on forwards; both sides together the mean.
  for (std::size_t i = 0; i < cloud.upright.size(); i += 2) {
    const glm::dvec3 front = meanColor(cloud.upright[i].picture.image),
                     back = meanColor(cloud.upright[i + 1].picture.image);
    EXPECT_LT(glm::distance(0.5 * (front + back), glm::dvec3(shown.mean)), 0.01);
    EXPECT_EQ(front.y<back.y, glm::dot(cloud.upright[i].sight.towards, scene.sun.direction)> 0);
  }
  const glm::dvec3 below = meanColor(cloud.level[1].picture.image),
                   above = meanColor(cloud.level[0].picture.image);
  EXPECT_GT(below.y, above.y);
}

TEST(Pictures, OfFlatCloudsLieLevelAlone) {
  scene::Scene scene = test::smallScene();
  for (std::uint32_t lit = 0; lit < scene.lit.size(); ++lit) {
    const shape::Bounds& box = scene.archetypes[scene.lit[lit].archetype].bounds;
    const glm::vec3 size = box.upper - box.lower;
    const CloudPictures cloud = picturesOf(scene, lit, 64);
    EXPECT_EQ(cloud.level.size() % 2, 0u);
    const NearPictures near = nearPicturesOf(scene, lit, 64);
    if (size.y < 0.2f * std::min(size.x, size.z)) {
      EXPECT_EQ(cloud.upright.size(), 0u);
      EXPECT_FALSE(near.turns);
      EXPECT_EQ(near.pictures.size(), cloud.level.size());
    }
    if (size.y > 0.6f * std::max(size.x, size.z)) {
      EXPECT_EQ(cloud.upright.size(), 4u);
      EXPECT_TRUE(near.turns);
    }
  }
}

TEST(Pictures, OfAnAtlasDoNotOverlap) {
  std::vector<image::ByteImage> pictures;
  for (int i = 0; i < 40; ++i) {
    const int width = 5 + 7 * i % 31, height = 4 + 5 * i % 23;
    pictures.push_back({width, height, 4,
                        std::vector<unsigned char>(static_cast<std::size_t>(4 * width * height),
                                                   static_cast<unsigned char>(i + 1))});
  }
  std::vector<const image::ByteImage*> pointers;
  for (const image::ByteImage& picture : pictures) pointers.push_back(&picture);
  const PictureAtlas atlas(pointers);
  std::size_t whole = 0;
  for (int i = 0; i < 40; ++i) {
    const auto shown = std::ranges::count(atlas.texture().bytes, static_cast<unsigned char>(i + 1));
    EXPECT_EQ(static_cast<std::size_t>(shown), pictures[static_cast<std::size_t>(i)].bytes.size());
    whole += pictures[static_cast<std::size_t>(i)].bytes.size();
  }
  EXPECT_LT(atlas.texture().bytes.size(), 3 * whole);
}

}  // namespace
}  // namespace cloudgen::writer
