// SPDX-License-Identifier: Apache-2.0
#include "image/impostor.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "base/thread.hpp"
#include "image/tiles.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

constexpr int kViews = 3, kPixels = 48;

/// A heap of round puffs, dark below and bright above.
struct Heap {
  std::vector<shape::Puff> puffs;
  std::vector<light::PuffLight> lights;
};

Heap heap() {
  base::RandomStream random(8, 8, base::Purpose::Test);
  Heap out;
  for (int i = 0; i < 60; ++i) {
    shape::Puff puff;
    puff.center = 220.0 * random.uniform() * random.direction() + glm::dvec3(100, 900, -50);
    puff.sigma = glm::dvec3(random.uniform(35, 60), random.uniform(30, 50), random.uniform(35, 60));
    puff.extinctionPerMeter = 0.02f;
    out.puffs.push_back(puff);
    out.lights.push_back({glm::vec3(0.4f + 0.5f * glm::smoothstep(700.0f, 1100.0f, puff.center.y)), 0.1f});
  }
  return out;
}

ImpostorAtlas baked(const Heap& cloud) {
  return bakeImpostor(cloud.puffs, cloud.lights, light::sunFrom(200, 40), {kViews, kPixels, true}, {});
}

const unsigned char* pixelOf(const ImpostorAtlas& atlas, int column, int row, int x, int y) {
  const auto at = static_cast<std::size_t>((row * kPixels + y) * atlas.color.width + column * kPixels + x);
  return atlas.color.bytes.data() + 4 * at;
}

TEST(Impostor, DirectionsGoThereAndBack) {
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) {
      const glm::dvec3 direction = impostorDirection(column, row, 8);
      EXPECT_NEAR(glm::length(direction), 1, 1e-12);
      EXPECT_GE(direction.y, 0);
      const glm::dvec2 back = onHemiOctahedron(direction);
      EXPECT_NEAR(back.x, 2 * column / 7.0 - 1, 1e-9);
      EXPECT_NEAR(back.y, 2 * row / 7.0 - 1, 1e-9);
      const bool outermost = row % 7 == 0 || column % 7 == 0;
      EXPECT_EQ(std::abs(direction.y) < 1e-9, outermost);
    }
  EXPECT_NEAR(hemiOctahedron({0, 0}).y, 1, 1e-12);
}

TEST(Impostor, AlphaIsZeroOnEveryTilesBorderAndColourIsDefined) {
  const ImpostorAtlas atlas = baked(heap());
  for (int row = 0; row < kViews; ++row)
    for (int column = 0; column < kViews; ++column)
      for (int i = 0; i < kPixels; ++i)
        for (const auto& [x, y] : {std::pair{i, 0}, {i, kPixels - 1}, {0, i}, {kPixels - 1, i}}) {
          const unsigned char* pixel = pixelOf(atlas, column, row, x, y);
          ASSERT_EQ(pixel[3], 0);
          ASSERT_GT(pixel[0], 100);
        }
}

TEST(Impostor, AViewIsAsOpaqueAndAsBrightAsTheCloudDrawnDirectly) {
  const Heap cloud = heap();
  const ImpostorAtlas atlas = baked(cloud);
  std::vector<Splat> splats;
  for (std::size_t i = 0; i < cloud.puffs.size(); ++i) {
    const glm::vec3 base = light::srgbFromLinear(cloud.lights[i].color);
    const glm::vec3 lining = light::srgbFromLinear(cloud.lights[i].color +
                                                   cloud.lights[i].forward * light::sunFrom(200, 40).color) -
                             base;
    splats.push_back({cloud.puffs[i].center, cloud.puffs[i].sigma, cloud.puffs[i].rotation,
                      1 - std::exp(-shape::frontalOpticalDepth(cloud.puffs[i])), base + 0.25f * lining,
                      0.5f * lining});
  }
  constexpr int kFiner = 3;
  for (const auto& [column, row] : {std::pair{1, 1}, {0, 1}, {2, 0}}) {
    const View view = parallelView(glm::dvec3(atlas.center), impostorDirection(column, row, kViews),
                                   atlas.radiusMeters, atlas.radiusMeters, kFiner * kPixels);
    const Volume volume(splats, view, {true, light::sunFrom(200, 40).direction});
    std::vector<glm::dvec2> direct(static_cast<std::size_t>(view.width * view.height));
    forEachPixel(volume, view.width, view.height, "", {}, [&](int x, int y, std::span<const Blob> blobs) {
      const Gathered seen = volume.along(view.rayAt(x + 0.5, y + 0.5), blobs, 1e6, jitterAt(x, y), {});
      direct[static_cast<std::size_t>(y * view.width + x)] = {1 - seen.open, seen.radiance.y};
    });
    glm::dvec2 drawn(0), held(0);  // alpha, alpha x brightness
    for (const glm::dvec2& pixel : direct) drawn += pixel / static_cast<double>(direct.size());
    for (int y = 0; y < kPixels; ++y)
      for (int x = 0; x < kPixels; ++x) {
        const unsigned char* pixel = pixelOf(atlas, column, row, x, y);
        const double alpha = pixel[3] / 255.0;
        held += glm::dvec2(alpha, alpha * light::linearFromSrgb(glm::vec3(pixel[1] / 255.0f)).x) /
                static_cast<double>(kPixels * kPixels);
      }
    EXPECT_GT(drawn.x, 0.1);
    EXPECT_NEAR(held.x, drawn.x, 0.02 * drawn.x);
    EXPECT_NEAR(held.y / held.x, drawn.y / drawn.x, 0.03 * drawn.y / drawn.x);
  }
}

TEST(Impostor, DepthLiesWhereTheCloudIs) {
  shape::Puff puff;
  puff.center = {0, 1000, 0};
  puff.sigma = glm::vec3(50);
  puff.extinctionPerMeter = 0.05f;
  const ImpostorAtlas atlas = bakeImpostor({&puff, 1}, std::vector<light::PuffLight>(1),
                                           light::sunFrom(200, 40), {kViews, kPixels, false}, {});
  EXPECT_NEAR(atlas.radiusMeters, 150, 20);
  const auto depthAt = [&](int x, int y) {
    return atlas.depth[static_cast<std::size_t>((kPixels + y) * atlas.color.width + kPixels + x)] / 65535.0;
  };
  EXPECT_EQ(depthAt(0, 0), 1);
  const double middle = 2 * atlas.radiusMeters * depthAt(kPixels / 2, kPixels / 2);
  EXPECT_LT(middle, atlas.radiusMeters);
  EXPECT_GT(middle, atlas.radiusMeters - 3 * 50);
}

TEST(Impostor, TheSameBytesForAnyNumberOfThreads) {
  const auto bytes = [](int threads) {
    const base::ThreadLimit limit(threads);
    return baked(heap()).color.bytes;
  };
  EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Impostor, NoPuffsNoCloud) {
  const ImpostorAtlas atlas = bakeImpostor({}, {}, light::sunFrom(200, 40), {2, 8, true}, {});
  EXPECT_EQ(atlas.radiusMeters, 0);
  for (std::size_t i = 3; i < atlas.color.bytes.size(); i += 4) ASSERT_EQ(atlas.color.bytes[i], 0);
}

}  // namespace
}  // namespace cloudgen::image
