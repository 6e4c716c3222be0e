// SPDX-License-Identifier: Apache-2.0
// Pictures of clouds from afar against the clouds in full, both drawn as viewers blend them.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/small_scene.hpp"
#include "writer/x3d/card_picture.hpp"
#include "writer/x3d/picture_atlas.hpp"

namespace cloudgen::writer {
namespace {

const image::SpriteAtlas kAtlas{
    .genus = base::Genus::Cumulus, .file = "cumulus.png", .columns = 4, .rows = 4, .tilePixels = 32};

/// Soft discs, 4 by 4.
SpriteSheet softDiscs() {
  constexpr int kSide = 128, kDisc = 32;
  image::ByteImage image{kSide, kSide, 4, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double away = std::hypot(x % kDisc - 15.5, y % kDisc - 15.5) / 15.5;
      for (int c = 0; c < 3; ++c) image.bytes.push_back(static_cast<unsigned char>(200 + x % kDisc));
      image.bytes.push_back(
          static_cast<unsigned char>(255 * std::max(0.0, std::exp(-2.4 * away * away) - 0.09)));
    }
  return SpriteSheet(image);
}

/// The area that is covered, in square metres, and the mean light of what covers it.
struct Seen {
  double cover = 0, luminance = 0;
};

Seen seen(const CardPicture& picture) {
  Seen sum;
  const auto& bytes = picture.pixels.bytes;
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    const double alpha = bytes[i + 3] / 255.0;
    sum.cover += alpha;
    sum.luminance += alpha * (0.2126 * bytes[i] + 0.7152 * bytes[i + 1] + 0.0722 * bytes[i + 2]) / 255;
  }
  sum.luminance /= sum.cover;
  const glm::vec2 size = picture.upper - picture.lower;
  sum.cover *= static_cast<double>(size.x) * size.y / (picture.pixels.width * picture.pixels.height);
  return sum;
}

TEST(Pictures, CoverAndShineAsTheCloudsInFullFromEverySide) {
  const scene::Scene scene = test::sceneOf({test::heap("Cu_1", base::Genus::Cumulus, 1500, 900, 5, 160)}, 2);
  const SpriteSheet sprites = softDiscs();
  for (std::uint32_t lit = 0; lit < scene.lit.size(); ++lit) {
    const auto parts = fullParts(scene, lit, 1, kAtlas);
    for (int view = 0; view < kViews; ++view) {
      const Seen near = seen(pictureOf(parts, sprites, 32, viewAxes(view), 8));
      for (const float metersPerPixel : {20.0f, 50.0f}) {
        const Seen far = seen(pictureOf(parts, sprites, 32, viewAxes(view), metersPerPixel));
        EXPECT_NEAR(far.cover / near.cover, 1, 0.02) << view << " at " << metersPerPixel;
        EXPECT_NEAR(far.luminance / near.luminance, 1, 0.03) << view << " at " << metersPerPixel;
      }
    }
  }
}

TEST(Pictures, HaveNothingAtTheirBorder) {
  const scene::Scene scene = test::smallScene();
  const CardPicture picture = pictureOf(fullParts(scene, 0, 1, kAtlas), softDiscs(), 32, viewAxes(3), 20);
  const auto width = static_cast<std::size_t>(picture.pixels.width),
             height = static_cast<std::size_t>(picture.pixels.height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      if (x == 0 || y == 0 || x + 1 == width || y + 1 == height) {
        EXPECT_EQ(picture.pixels.bytes[4 * (y * width + x) + 3], 0);
      }
}

TEST(Pictures, AxesOfTheViewsAreUprightAndRightHanded) {
  for (int view = 0; view < kViews; ++view) {
    const ViewAxes axes = viewAxes(view);
    EXPECT_NEAR(glm::length(glm::cross(axes.x, axes.y) - axes.z), 0, 1e-5) << view;
    EXPECT_NEAR(glm::length(axes.x), 1, 1e-5);
    EXPECT_NEAR(axes.x.y, 0, 1e-6);
  }
  EXPECT_NEAR(viewAxes(2).z.x, std::cos(kElevationDegrees * 3.14159265f / 180), 1e-5);  // from the east
}

TEST(Pictures, LieInAnAtlasWithoutOverlap) {
  std::vector<CardPicture> pictures;
  for (const auto& [width, height] : {std::pair{7, 3}, {2, 9}, {30, 4}, {5, 5}, {1, 1}}) {
    CardPicture picture;
    picture.pixels = {width, height, 4, {}};
    picture.pixels.bytes.assign(static_cast<std::size_t>(4 * width * height),
                                static_cast<unsigned char>(1 + pictures.size()));
    pictures.push_back(picture);
  }
  const PictureAtlas atlas = packed(pictures);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto owned =
        std::count(atlas.pixels.bytes.begin(), atlas.pixels.bytes.end(), 1 + static_cast<int>(i));
    EXPECT_EQ(owned, std::ssize(pictures[i].pixels.bytes)) << i;
    const glm::vec4& box = atlas.boxes[i];
    EXPECT_NEAR((box.z - box.x) * static_cast<float>(atlas.pixels.width), pictures[i].pixels.width, 1e-3);
    EXPECT_NEAR((box.w - box.y) * static_cast<float>(atlas.pixels.height), pictures[i].pixels.height, 1e-3);
  }
}

}  // namespace
}  // namespace cloudgen::writer
