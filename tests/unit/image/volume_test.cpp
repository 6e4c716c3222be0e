// SPDX-License-Identifier: Apache-2.0
#include "image/volume.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "image/heap_noise.hpp"

namespace cloudgen::image {
namespace {

View straightAhead() { return viewOf({{0, 0, 0}, {0, 0, -1000}, 45, 64, 64}); }

Gathered through(const std::vector<Splat>& splats, const glm::dvec3& direction, bool detail,
                 float jitter = 0.5f, double far = 1e6) {
  const Volume volume(splats, straightAhead(), {.detail = detail});
  return volume.along({glm::dvec3(0), glm::normalize(direction)}, volume.blobs(), far, jitter, {});
}

Splat grey(const glm::vec3& center, const glm::vec3& sigma, float opacity) {
  Splat splat;
  splat.center = center;
  splat.sigma = sigma;
  splat.opacity = opacity;
  splat.color = glm::vec3(0.5f);
  return splat;
}

TEST(Volume, ARayThroughTheMiddleOfAPuffMeetsItsOpticalDepth) {
  for (const float opacity : {0.1f, 0.5f, 0.9f})
    for (const float jitter : {0.0f, 0.4f, 1.0f}) {
      const Gathered seen = through({grey({0, 0, -2000}, {60, 60, 60}, opacity)}, {0, 0, -1}, false, jitter);
      EXPECT_NEAR(1 - seen.open, opacity, 0.02 * opacity);
      EXPECT_NEAR(seen.water, -std::log(1 - opacity), -0.02 * std::log(1 - opacity));
      EXPECT_NEAR(seen.distance, 2000, 60);
    }
}

TEST(Volume, AlongItsLongAxisAPuffIsAsMuchDeeper) {
  // A disc seen edge on: ten times its depth through the thin way.
  const Gathered seen = through({grey({0, 0, -3000}, {200, 20, 200}, 0.1f)}, {0, 0, -1}, false);
  EXPECT_NEAR(seen.water, -10 * std::log(0.9f), 0.03);
}

TEST(Volume, OverlappingPuffsAddUpInAnyOrder) {
  const std::vector<Splat> both{grey({0, 0, -2000}, glm::vec3(60), 0.5f),
                                grey({0, 0, -2040}, glm::vec3(80), 0.4f)};
  const Gathered seen = through(both, {0, 0, -1}, false),
                 turned = through({both[1], both[0]}, {0, 0, -1}, false);
  EXPECT_NEAR(seen.open, 0.5 * 0.6, 0.01);
  EXPECT_NEAR(seen.open, turned.open, 1e-5);
}

TEST(Volume, AThreadWithinAVeilIsNotSteppedOver) {
  const std::vector<Splat> both{grey({0, 0, -5000}, {4000, 100, 1500}, 0.05f),
                                grey({0, 0, -5000}, {300, 5, 5}, 0.5f)};
  float least = 1, most = 0;
  for (const float jitter : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const float open = through(both, {0, 0, -1}, false, jitter).open;
    least = std::min(least, open);
    most = std::max(most, open);
  }
  EXPECT_LT(most - least, 0.02f);
  EXPECT_LT(most, 0.5f);
}

TEST(Volume, WhatLiesBehindTheFarEndIsNotSeen) {
  EXPECT_EQ(through({grey({0, 0, -2000}, glm::vec3(60), 0.9f)}, {0, 0, -1}, true, 0.5f, 1500).open, 1);
}

TEST(Volume, PuffsThinnerThanAPixelKeepTheirLight) {
  // The mean over the pixels about it is its extinction area over theirs.
  const float sigma = 4, distance = 20000;
  const View view = straightAhead();
  const std::vector<Splat> splats{grey({0, 0, -distance}, glm::vec3(sigma), 0.6f)};
  const Volume volume(splats, view, {.detail = false});
  double depth = 0;
  for (int y = 24; y < 40; ++y)
    for (int x = 24; x < 40; ++x) {
      const Gathered seen = volume.along(view.rayAt(x + 0.5, y + 0.5), volume.blobs(), 1e6, 0.5f, {});
      depth += seen.water + seen.ice;
    }
  const double area = std::pow(view.pixelMeters(distance), 2.0);
  EXPECT_NEAR(depth * area, -std::log(0.4) * 2 * 3.14159265 * sigma * sigma, 12);
}

TEST(Volume, NoiseTearsHeapsButNotVeils) {
  double heapSpread = 0, veilSpread = 0;
  for (int i = -20; i <= 20; ++i) {
    const glm::dvec3 direction(0.002 * i, 0, -1);
    const auto spread = [&](const Splat& splat) {
      return std::abs(through({splat}, direction, true).water - through({splat}, direction, false).water) /
             (1e-3 + through({splat}, direction, false).water);
    };
    heapSpread += spread(grey({0, 0, -2000}, {60, 60, 60}, 0.8f));
    veilSpread += spread(grey({0, 0, -2000}, {400, 30, 400}, 0.05f));
  }
  EXPECT_GT(heapSpread, 2 * veilSpread);
}

TEST(Volume, TheListOfABoxHoldsWhateverItsRaysMeet) {
  std::vector<Splat> splats;
  for (int i = 0; i < 30; ++i)
    splats.push_back(grey({40.0f * static_cast<float>(i - 15), 12.0f * static_cast<float>(i % 7 - 3), -1500},
                          {30, 10, 20}, 0.4f));
  const View view = straightAhead();
  const Volume volume(splats, view, {.detail = false});
  for (int top = 0; top < 64; top += 8)
    for (int left = 0; left < 64; left += 8) {
      const auto list = volume.blobsOf(volume.listFor(left, top, 8, 8, volume.all()));
      EXPECT_LT(list.size(), splats.size());
      for (const int corner : {0, 7}) {
        const Ray ray = view.rayAt(left + corner + 0.5, top + corner + 0.5);
        EXPECT_EQ(volume.along(ray, list, 1e6, 0.5f, {}).open,
                  volume.along(ray, volume.blobs(), 1e6, 0.5f, {}).open);
      }
    }
}

TEST(HeapNoise, LiesBetweenZeroAndOneAndRepeats) {
  const HeapNoise& noise = heapNoise();
  double sum = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 point(0.37f * static_cast<float>(i % 41), 0.29f * static_cast<float>(i % 53),
                          0.23f * static_cast<float>(i % 59));
    const float value = noise.at(point), octaves = noise.octaves(100.0f * point, 150, 4);
    ASSERT_TRUE(value >= 0 && value <= 1 && octaves >= 0 && octaves <= 1);
    ASSERT_NEAR(noise.at(point + glm::vec3(16, -16, 32)), value, 1e-4f);
    sum += octaves;
  }
  EXPECT_NEAR(sum / 4000, 0.5, 0.12);
}

TEST(HeapNoise, OctavesComeAndGoGradually) {
  const glm::vec3 point(123.4f, 56.7f, 89.1f);
  for (float longest = 60; longest < 300; longest *= 1.01f)
    EXPECT_NEAR(heapNoise().octaves(point, longest, 5), heapNoise().octaves(point, 1.01f * longest, 5),
                0.06f);
}

}  // namespace
}  // namespace cloudgen::image
