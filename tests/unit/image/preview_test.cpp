// SPDX-License-Identifier: Apache-2.0
#include "image/preview.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "base/thread.hpp"
#include "image/backdrop.hpp"
#include "image/tone.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

constexpr int kWidth = 200, kHeight = 100;

Surroundings noon() {
  Surroundings around;
  around.sun = light::sunFrom(180, 50);
  around.sky = light::skyUnder(around.sun);
  return around;
}

/// Looks north from 1 km up: one pixel is 1 / 120.71 of the distance.
Camera northwards() { return {{0, 1000, 0}, {0, 1000, -1000}, 45, kWidth, kHeight}; }
constexpr double kFocalPixels = 120.7106781;

Splat red(const glm::vec3& center, float sigma = 20) {
  Splat splat;
  splat.center = center;
  splat.sigma = glm::vec3(sigma);
  splat.color = {1, 0, 0};
  return splat;
}

Picture drawn(const std::vector<Splat>& splats) {
  return render(splats, northwards(), noon(), {.detail = false}, {});
}

struct Pixel {
  int x = 0, y = 0;
};

Pixel mostChanged(const Picture& a, const Picture& b) {
  Pixel most;
  float difference = -1;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (const float here = glm::distance(a.at(x, y), b.at(x, y)); here > difference)
        difference = here, most = {x, y};
  return most;
}

TEST(Preview, AnEmptySkyIsTheBackdrop) {
  const Picture picture = drawn({});
  const Backdrop backdrop({}, noon(), {0, 1000, 0});
  for (const Pixel pixel : {Pixel{0, 0}, Pixel{100, 20}, Pixel{199, 99}, Pixel{50, 80}}) {
    const glm::dvec3 ray((pixel.x + 0.5 - 100) / kFocalPixels, (50 - pixel.y - 0.5) / kFocalPixels, -1);
    const glm::vec3 expected =
        displayed(backdrop.radianceAlong({0, 1000, 0}, glm::normalize(ray)) +
                  (ray.y > 0 ? backdrop.sunlightThrough(glm::normalize(ray), 0, 0) : glm::vec3(0)));
    EXPECT_LT(glm::distance(picture.at(pixel.x, pixel.y), expected), 1e-4f);
  }
}

TEST(Preview, ASplatLandsWhereThePerspectivePutsIt) {
  const Picture empty = drawn({});
  for (const glm::vec3& center :
       {glm::vec3(100, 1050, -1000), glm::vec3(-300, 1200, -900), glm::vec3(0, 1060, -700)}) {
    Splat splat = red(center);
    splat.opacity = 0.5f;
    const Pixel hit = mostChanged(drawn({splat}), empty);
    EXPECT_NEAR(hit.x + 0.5, 100 + kFocalPixels * center.x / -center.z, 1.01);
    EXPECT_NEAR(hit.y + 0.5, 50 - kFocalPixels * (center.y - 1000) / -center.z, 1.01);
  }
}

TEST(Preview, ALongSplatIsDrawnAlongItsTurnedAxis) {
  Splat thread = red({0, 1100, -1000});
  thread.sigma = {150, 8, 8};
  thread.rotation = glm::angleAxis(glm::radians(45.0f), glm::vec3(0, 0, 1));
  const Picture picture = drawn({thread}), empty = drawn({});
  const auto changed = [&](int x, int y) { return glm::distance(picture.at(x, y), empty.at(x, y)); };
  const int middle = 50 - 12;
  EXPECT_GT(changed(112, middle - 12), 0.2f);
  EXPECT_GT(changed(88, middle + 12), 0.2f);
  EXPECT_LT(changed(88, middle - 12), 0.02f);
}

TEST(Preview, TheNearerHidesTheFartherInAnyOrder) {
  Splat far = red({0, 1000, -2000}, 60);
  Splat near = red({0, 1000, -1000}, 40);
  near.color = {0, 1, 0};
  for (const auto& splats : {std::vector{far, near}, std::vector{near, far}}) {
    const glm::vec3 pixel = drawn(splats).at(100, 50);
    EXPECT_GT(pixel.g, 0.8f);
    EXPECT_LT(pixel.r, 0.3f);
  }
}

TEST(Preview, WhatIsBehindTheCameraIsNotSeen) {
  const Picture empty = drawn({}), picture = drawn({red({0, 1500, 1000}), red({0, 1000, 100})});
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(picture.at(x, y), empty.at(x, y));
}

TEST(Preview, ACoarsePictureComesFirst) {
  int calls = 0;
  RenderOptions options{.detail = false};
  options.coarse = [&](const Picture& coarse) {
    ++calls;
    EXPECT_EQ(coarse.width, kWidth);
    EXPECT_EQ(coarse.height, kHeight);
  };
  const auto cloud = std::vector{red({0, 1100, -1000}, 100)};
  const Picture with = render(cloud, northwards(), noon(), options, {});
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(with.pixels, drawn(cloud).pixels);
}

TEST(Preview, FaintSplatsLetTheSkyThrough) {
  // Below the tone curve's knee colours mix in proportion.
  Splat faint = red({0, 1361, -1000}, 60), opaque = faint;
  faint.color = opaque.color = {0.6f, 0.2f, 0.2f};
  faint.opacity = 0.5f;
  const auto seen = [](const std::vector<Splat>& splats) {
    return light::linearFromSrgb(drawn(splats).at(100, 6));
  };
  const glm::vec3 sky = seen({}), full = seen({opaque}), half = seen({faint});
  EXPECT_LT(glm::distance(half, 0.5f * (sky + full)), 0.04f);
}

std::vector<Splat> field() {
  base::RandomStream random(5, 5, base::Purpose::Test);
  std::vector<Splat> splats;
  for (int i = 0; i < 400; ++i) {
    Splat splat =
        red(glm::dvec3(random.uniform(-6000, 6000), random.uniform(800, 2500), random.uniform(-9000, 3000)));
    splat.sigma = glm::dvec3(random.uniform(1, 300), random.uniform(1, 200), random.uniform(1, 300));
    splat.opacity = static_cast<float>(random.uniform());
    splats.push_back(splat);
  }
  return splats;
}

TEST(Preview, TheSamePixelsForAnyNumberOfThreads) {
  const auto picture = [](int threads) {
    const base::ThreadLimit limit(threads);
    return render(field(), northwards(), noon(), {}, {}).pixels;
  };
  EXPECT_EQ(picture(1), picture(2));
}

TEST(Preview, EveryPixelIsANumberEvenAmongTheClouds) {
  Camera inside = northwards();
  for (const double height : {0.0, 1500.0}) {
    inside.eye.y = height;
    for (const glm::vec3& pixel : render(field(), inside, noon(), {}, {}).pixels)
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(pixel[c]) && pixel[c] >= 0 && pixel[c] < 1.2f);
  }
}

}  // namespace
}  // namespace cloudgen::image
