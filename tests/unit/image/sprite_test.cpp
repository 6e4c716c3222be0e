// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <set>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "image/sprite_atlas.hpp"
#include "image/sprite_bake.hpp"
#include "support/read_png.hpp"
#include "support/scratch.hpp"

namespace cloudgen::image {
namespace {

std::filesystem::path textures() { return base::dataDir() / "textures"; }

/// Alpha is the last channel, whatever the others are.
int alphaAt(const ByteImage& image, int x, int y) {
  return image.bytes[static_cast<std::size_t>((y * image.width + x + 1) * image.channels - 1)];
}

TEST(Sprites, EveryGenusHasAnAtlas) {
  const auto atlases = readSpriteManifest(textures());
  std::set<std::string> files;
  for (const base::Genus genus : base::allGenera()) {
    const SpriteAtlas& atlas = atlasOf(atlases, genus);
    EXPECT_EQ(atlas.genus, genus);
    EXPECT_EQ(atlas.tiles(), 16);
    EXPECT_TRUE(std::filesystem::is_regular_file(textures() / atlas.file)) << atlas.file;
    files.insert(atlas.file);
  }
  EXPECT_EQ(files.size(), static_cast<std::size_t>(base::kGenusCount));
}

TEST(Sprites, TilesEndTransparentAndAreOpaqueInside) {
  for (const SpriteAtlas& atlas : readSpriteManifest(textures())) {
    const ByteImage image = test::readPng(textures() / atlas.file);
    ASSERT_EQ(image.width, 512) << atlas.file;
    ASSERT_EQ(image.height, 512) << atlas.file;
    ASSERT_TRUE(image.channels == 2 || image.channels == 4) << atlas.file;
    const int side = atlas.tilePixels;
    int opaquest = 0;
    for (int y = 0; y < 512; ++y)
      for (int x = 0; x < 512; ++x) {
        const int alpha = alphaAt(image, x, y);
        opaquest = std::max(opaquest, alpha);
        const bool onBorder = x % side == 0 || x % side == side - 1 || y % side == 0 || y % side == side - 1;
        ASSERT_TRUE(!onBorder || alpha == 0) << atlas.file << ' ' << x << ' ' << y;
        if (alpha > 0) continue;
        for (int c = 0; c + 1 < image.channels; ++c)
          ASSERT_GT(image.bytes[static_cast<std::size_t>((y * 512 + x) * image.channels + c)], 30)
              << atlas.file;
      }
    EXPECT_GT(opaquest, 0.9 * 255) << atlas.file;
  }
}

// A viewer that makes mip levels must not find edges there: quads would be seen as such.
TEST(Sprites, MipLevelsEndTransparentToo) {
  for (const SpriteAtlas& atlas : readSpriteManifest(textures())) {
    const ByteImage image = test::readPng(textures() / atlas.file);
    for (int shrink = 2; atlas.tilePixels / shrink >= 8; shrink *= 2) {
      const int side = atlas.tilePixels / shrink, all = image.width / shrink;
      int most = 0;
      for (int y = 0; y < all; ++y)
        for (int x = 0; x < all; ++x) {
          if (x % side != 0 && x % side != side - 1 && y % side != 0 && y % side != side - 1) continue;
          int sum = 0;
          for (int i = 0; i < shrink * shrink; ++i)
            sum += alphaAt(image, x * shrink + i % shrink, y * shrink + i / shrink);
          most = std::max(most, sum / (shrink * shrink));
        }
      // Flanks are as soft as those of the Gaussians that they stand for: a border of a sixteenth or an eighth of the
      // sprite has some of them.
      EXPECT_LE(most, side > 16 ? 4 : side > 8 ? 20 : 40) << atlas.file << ' ' << side;
    }
  }
}

// Else a cloud of sprites would cover less than the puffs that they stand for, and the check would not see it.
TEST(Sprites, EachIsAsOpaqueAsTheGaussianThatItStandsFor) {
  const double wanted = 0.5 * std::numbers::pi * kWithinSprite / (kSpriteReach * kSpriteReach);
  for (const SpriteAtlas& atlas : readSpriteManifest(textures())) {
    const ByteImage image = test::readPng(textures() / atlas.file);
    for (int tile = 0; tile < atlas.tiles(); ++tile) {
      const int side = atlas.tilePixels, left = tile % atlas.columns * side, top = tile / atlas.columns * side;
      double sum = 0, nearMiddle = 0;  // within a deviation: 39 % of a Gaussian, of which 91 % are left
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const double alpha = alphaAt(image, left + x, top + y) / 255.0;
          sum += alpha;
          if (std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) * 2 * kSpriteReach < side) nearMiddle += alpha;
        }
      EXPECT_NEAR(sum / (side * side), wanted, 0.02 * wanted) << atlas.file << ' ' << tile;
      EXPECT_NEAR(nearMiddle / sum, 0.3935 / kWithinSprite, 0.06) << atlas.file << ' ' << tile;
    }
  }
}

TEST(Sprites, TheCommittedSetIsWhatIsBaked) {
  const ByteImage committed = test::readPng(textures() / "cumulus.png"),
                  baked = bakeSprites(base::Genus::Cumulus, false).color;
  EXPECT_EQ(baked.channels, committed.channels);
  EXPECT_TRUE(baked.bytes == committed.bytes)
      << "make the set again with: cloudgen textures --no-maps -o textures";
}

TEST(Sprites, TheCommittedLightMapsAreWhatIsBaked) {
  const auto atlases = readSpriteManifest(textures());
  const SpriteAtlas& atlas = atlasOf(atlases, base::Genus::Cumulus);
  const SpriteSheets baked = bakeSprites(base::Genus::Cumulus, true);
  EXPECT_TRUE(test::readPng(textures() / atlas.sixwayA).bytes == halved(baked.maps->sixwayA).bytes)
      << "make the set again with: cloudgen textures --no-maps -o textures";
  EXPECT_TRUE(test::readPng(textures() / atlas.sixwayB).bytes == halved(baked.maps->sixwayB).bytes);
}

TEST(Sprites, LightMapsBelongToTheSprite) {
  const SpriteSheets sheets = bakeSprites(base::Genus::Cumulus, true);
  ASSERT_TRUE(sheets.maps);
  const SpriteMaps& maps = *sheets.maps;
  // Mean over what is seen in the halves of a tile: upper - lower and right - left.
  const auto leaning = [&](const ByteImage& image, int channel, bool sideways) {
    double sum = 0, weight = 0;
    for (int y = 0; y < kSpriteTilePixels; ++y)
      for (int x = 0; x < kSpriteTilePixels; ++x) {
        const int place = sideways ? x : kSpriteTilePixels - 1 - y;
        const auto* pixel = image.bytes.data() + 4 * (y * image.width + x);
        sum += (place < kSpriteTilePixels / 2 ? -1 : 1) * pixel[channel] * pixel[3];
        weight += pixel[3];
      }
    return sum / weight;
  };
  EXPECT_GT(leaning(maps.sixwayA, 0, true), 10);
  EXPECT_GT(leaning(maps.sixwayA, 1, false), 10);
  EXPECT_LT(leaning(maps.sixwayB, 0, true), -10);
  EXPECT_LT(leaning(maps.sixwayB, 1, false), -10);
  EXPECT_GT(leaning(maps.normal, 0, true), 10);
  EXPECT_GT(leaning(maps.normal, 1, false), 10);
  double front = 0, back = 0;
  for (std::size_t i = 0; i < sheets.color.bytes.size() / 2; ++i) {
    ASSERT_EQ(maps.normal.bytes[4 * i + 3], sheets.color.bytes[2 * i + 1]);
    ASSERT_GT(maps.normal.bytes[4 * i + 2], 120);  // towards the eye, under zero alpha too
    front += maps.sixwayB.bytes[4 * i + 2] * sheets.color.bytes[2 * i + 1];
    back += maps.sixwayA.bytes[4 * i + 2] * sheets.color.bytes[2 * i + 1];
  }
  EXPECT_GT(front, 1.1 * back);
}

TEST(Sprites, TextureBoxesLieInsideTheirTiles) {
  const SpriteAtlas atlas{
      .genus = base::Genus::Cumulus, .file = "a.png", .columns = 4, .rows = 2, .tilePixels = 64};
  for (int tile = 0; tile < atlas.tiles(); ++tile) {
    const glm::vec4 box = atlas.textureBox(tile);
    const float left = static_cast<float>(tile % 4) / 4, top = 1 - static_cast<float>(tile / 4) / 2;
    EXPECT_FLOAT_EQ(box.x, left + 0.5f / 256);
    EXPECT_FLOAT_EQ(box.z, left + 0.25f - 0.5f / 256);
    EXPECT_FLOAT_EQ(box.w, top - 0.5f / 128);
    EXPECT_FLOAT_EQ(box.y, top - 0.5f + 0.5f / 128);
  }
}

TEST(Sprites, ABrokenManifestIsRefused) {
  const test::Scratch folder;
  EXPECT_THROW(readSpriteManifest(folder.path()), base::InputError);
  for (const char* text : {"", "[]", "{\"atlases\": []}",
                           "{\"atlases\": [{\"genus\": \"Xy\", \"file\": \"a.png\", \"sixway_a\": \"b.png\", "
                           "\"sixway_b\": \"c.png\", \"columns\": 1, "
                           "\"rows\": 1, \"tile_pixels\": 8}]}",
                           "{\"atlases\": [{\"genus\": \"Cu\", \"file\": \"../a.png\", \"sixway_a\": "
                           "\"b.png\", \"sixway_b\": \"c.png\", \"columns\": 1, "
                           "\"rows\": 1, \"tile_pixels\": 8}]}",
                           "{\"atlases\": [{\"genus\": \"Cu\", \"file\": \"a.png\", \"sixway_a\": \"b.png\", "
                           "\"sixway_b\": \"c.png\", \"columns\": 0, "
                           "\"rows\": 1, \"tile_pixels\": 8}]}"}) {
    folder.write("manifest.json", text);
    EXPECT_THROW(readSpriteManifest(folder.path()), base::InputError) << text;
  }
}

}  // namespace
}  // namespace cloudgen::image
