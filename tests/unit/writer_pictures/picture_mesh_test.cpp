// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/picture_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>

#include "support/small_scene.hpp"
#include "writer/pictures/cloud_pictures.hpp"

namespace cloudgen::writer {
namespace {

/// Opacity times area, and luminance times that.
struct Shown {
  double cover = 0, light = 0;
  double luminance() const { return light / cover; }
};

void add(Shown& sum, const glm::vec4& color, double area) {
  sum.cover += area * color.w;
  sum.light += area * color.w * (0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z);
}

Shown shownBy(const PuffPicture& picture) {
  Shown sum;
  const glm::vec2 sides = picture.upper - picture.lower;
  const double pixel = static_cast<double>(sides.x) * sides.y / (picture.image.width * picture.image.height);
  const auto& bytes = picture.image.bytes;
  for (std::size_t i = 0; i < bytes.size(); i += 4)
    add(sum, glm::vec4(bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]) / 255.0f, pixel);
  return sum;
}

double areaOf(const PictureMesh& mesh, std::size_t triangle) {
  const glm::vec2 &a = mesh.points[mesh.indices[triangle]], &b = mesh.points[mesh.indices[triangle + 1]],
                  &c = mesh.points[mesh.indices[triangle + 2]];
  return 0.5 * static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/// As a viewer fills triangles: colours and opacities go straight from corner to corner.
Shown shownBy(const PictureMesh& mesh) {
  constexpr int kSteps = 8;
  Shown sum;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; i + j < kSteps; ++j) {
        const float u = (static_cast<float>(i) + 1 / 3.0f) / kSteps,
                    v = (static_cast<float>(j) + 1 / 3.0f) / kSteps;
        const bool hasOther = i + j + 1 < kSteps;
        const auto at = [&](float p, float q) {
          return (1 - p - q) * mesh.colors[mesh.indices[t]] + p * mesh.colors[mesh.indices[t + 1]] +
                 q * mesh.colors[mesh.indices[t + 2]];
        };
        const double area = areaOf(mesh, t) / (kSteps * kSteps);
        add(sum, at(u, v), area);
        if (hasOther) add(sum, at(u + 1 / 3.0f / kSteps, v + 1 / 3.0f / kSteps), area);
      }
  return sum;
}

PictureMesh meshOf(const PuffPicture& picture, std::size_t mostTriangles) {
  return meshesOf(picture, std::array{mostTriangles}).front();
}

TEST(PictureMesh, OfSeveralSizesAreThoseOfEach) {
  const PuffPicture picture = picturesOf(test::smallScene(), 0, 64).level[0].picture;
  const std::vector<PictureMesh> both = meshesOf(picture, std::array<std::size_t, 2>{60, 300});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].indices, meshOf(picture, 60).indices);
  EXPECT_EQ(both[1].indices, meshOf(picture, 300).indices);
  EXPECT_LT(both[0].indices.size(), both[1].indices.size());
}

TEST(PictureMesh, CoversAndIsAsBrightAsItsPicture) {
  const scene::Scene scene = test::smallScene();
  for (std::uint32_t lit = 0; lit < scene.lit.size(); ++lit) {
    const CloudPictures cloud = picturesOf(scene, lit, 64);
    const NearPictures near = nearPicturesOf(scene, lit, 64);
    for (const auto* some : {&cloud.level, &cloud.upright, &near.pictures})
      for (const CloudPicture& one : *some)
        for (const std::size_t most : {60u, 120u, 400u}) {
          const Shown wanted = shownBy(one.picture), mesh = shownBy(meshOf(one.picture, most));
          EXPECT_NEAR(mesh.cover, wanted.cover, 0.02 * wanted.cover) << lit << " " << most;
          EXPECT_NEAR(mesh.luminance(), wanted.luminance(), 0.03 * wanted.luminance()) << lit << " " << most;
        }
  }
}

/// Root of the mean square by which a pixel differs, of 255, opacity multiplied into the colours.
double differenceOf(const PuffPicture& picture, const PictureMesh& mesh) {
  const glm::ivec2 size(picture.image.width, picture.image.height);
  const glm::vec2 step = (picture.upper - picture.lower) / glm::vec2(size);
  double sum = 0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::vec2 at(picture.lower.x + step.x * (static_cast<float>(x) + 0.5f),
                         picture.upper.y - step.y * (static_cast<float>(y) + 0.5f));
      glm::vec4 shown(0);
      for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto corner = [&](std::size_t i) { return mesh.points[mesh.indices[t + i % 3]]; };
        glm::vec3 shares;
        for (std::size_t i = 0; i < 3; ++i) {
          const glm::vec2 edge = corner(i + 2) - corner(i + 1), away = at - corner(i + 1);
          shares[static_cast<int>(i)] = 0.5f * (edge.x * away.y - edge.y * away.x) / static_cast<float>(areaOf(mesh, t));
        }
        if (std::min({shares.x, shares.y, shares.z}) < 0) continue;
        shown = glm::vec4(0);
        for (std::size_t i = 0; i < 3; ++i) shown += shares[static_cast<int>(i)] * mesh.colors[mesh.indices[t + i]];
      }
      const auto* pixel = &picture.image.bytes[4 * static_cast<std::size_t>(y * size.x + x)];
      for (int c = 0; c < 3; ++c) sum += std::pow(shown.w * shown[c] * 255 - pixel[c] * pixel[3] / 255.0, 2);
      sum += std::pow(255 * shown.w - pixel[3], 2);
    }
  return std::sqrt(sum / (4.0 * size.x * size.y));
}

TEST(PictureMesh, ShowsItsPicture) {
  const scene::Scene scene = test::smallScene();
  for (std::uint32_t lit = 0; lit < scene.lit.size(); ++lit) {
    const PuffPicture picture = nearPicturesOf(scene, lit, 64).pictures.front().picture;
    EXPECT_LT(differenceOf(picture, meshOf(picture, 130)), 14) << lit;
    EXPECT_LT(differenceOf(picture, meshOf(picture, 480)), 4) << lit;
  }
}

TEST(PictureMesh, TellsHowMuchOfItsPictureItMisses) {
  const scene::Scene scene = test::smallScene();
  const PuffPicture picture = nearPicturesOf(scene, 0, 64).pictures.front().picture;
  const glm::vec2 sides = picture.upper - picture.lower;
  for (const std::size_t most : {40u, 120u, 480u}) {
    const PictureMesh mesh = meshOf(picture, most);
    // A mean square is no less than that of the mean.
    const double root = differenceOf(picture, mesh) / 255, area = static_cast<double>(sides.x) * sides.y;
    EXPECT_LT(mesh.missMeters * 2 * (sides.x + sides.y), 1.1 * root * area) << most;
    EXPECT_GT(mesh.missMeters * 2 * (sides.x + sides.y), 0.2 * root * area) << most;
    EXPECT_GT(meshOf(picture, most / 2).missMeters, mesh.missMeters) << most;
  }
}

TEST(PictureMesh, HasNoMoreTrianglesThanWantedAndNoneTurnedAway) {
  const scene::Scene scene = test::smallScene();
  const CloudPictures cloud = picturesOf(scene, 0, 64);
  for (const std::size_t most : {20u, 60u, 300u}) {
    const PictureMesh mesh = meshOf(cloud.level[0].picture, most);
    EXPECT_LE(mesh.indices.size() / 3, most);
    EXPECT_GT(mesh.indices.size() / 3, most / 3);
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) EXPECT_GT(areaOf(mesh, t), 0);
  }
}

TEST(PictureMesh, NoEdgeMeetsTheMiddleOfAnother) {
  const scene::Scene scene = test::smallScene();
  const PictureMesh mesh = meshOf(picturesOf(scene, 0, 64).level[0].picture, 200);
  const auto at = [&](std::size_t i) { return mesh.points[mesh.indices[i]]; };
  for (std::size_t t = 0; t < mesh.indices.size(); ++t) {
    const glm::vec2 a = at(t), b = at(t - t % 3 + (t + 1) % 3);
    for (const glm::vec2& point : mesh.points)
      EXPECT_GT(glm::distance(point, 0.5f * (a + b)), 1e-3f * glm::distance(a, b));
  }
}

// An edge with a triangle on one side alone is an end of what is drawn: it must not be seen as one.
TEST(PictureMesh, EndsTransparent) {
  const scene::Scene scene = test::smallScene();
  for (std::uint32_t lit = 0; lit < scene.lit.size(); ++lit) {
    const PictureMesh mesh = meshOf(nearPicturesOf(scene, lit, 64).pictures.front().picture, 400);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}})
        ++sides[std::minmax(mesh.indices[t + static_cast<std::size_t>(a)], mesh.indices[t + static_cast<std::size_t>(b)])];
    for (const auto& [ends, count] : sides)
      if (count == 1) {
        EXPECT_LT(std::max(mesh.colors[ends.first].w, mesh.colors[ends.second].w), 0.05) << lit;
      }
  }
}

TEST(PictureMesh, OfNothingIsEmpty) { EXPECT_TRUE(meshOf(PuffPicture{}, 100).indices.empty()); }

}  // namespace
}  // namespace cloudgen::writer
