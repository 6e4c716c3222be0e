// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "image/atmosphere.hpp"
#include "image/sun_glare.hpp"
#include "image/tone.hpp"

namespace cloudgen::image {
namespace {

Atmosphere skyWithSun(double azimuth, double elevation, double height = 0) {
  const light::Sun sun = light::sunFrom(azimuth, elevation);
  return {sun, light::skyUnder(sun), height};
}

glm::dvec3 towards(double azimuth, double elevation) { return light::sunFrom(azimuth, elevation).direction; }

double glare(double degrees, float water, float ice) {
  return glareAndHalo(std::cos(glm::radians(degrees)), water, ice).y;
}

TEST(Atmosphere, TheZenithIsBlueAndTheHorizonPaler) {
  const Atmosphere noon = skyWithSun(180, 50);
  const glm::vec3 zenith = noon.sky({0, 1, 0}), horizon = noon.sky(towards(0, 1));
  EXPECT_GT(zenith.z, 2 * zenith.x);
  EXPECT_GT(zenith.z, zenith.y);
  EXPECT_GT(horizon.x / horizon.z, 1.5 * zenith.x / zenith.z);
  EXPECT_GT(horizon.y, zenith.y);
}

TEST(Atmosphere, TheLowSunsSideIsRed) {
  const Atmosphere evening = skyWithSun(270, 4);
  const glm::vec3 west = evening.sky(towards(270, 2)), east = evening.sky(towards(90, 20));
  EXPECT_GT(west.x, 1.3 * west.z);
  EXPECT_GT(west.x, east.x);
}

TEST(Atmosphere, FromHighUpTheZenithIsDarker) {
  EXPECT_LT(skyWithSun(180, 50, 12000).sky({0, 1, 0}).y, 0.5f * skyWithSun(180, 50).sky({0, 1, 0}).y);
}

TEST(Atmosphere, NightIsDarkAndEveryDirectionANumber) {
  for (const double elevation : {-20.0, -1.0, 0.0, 30.0, 90.0}) {
    const Atmosphere atmosphere = skyWithSun(120, elevation);
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 sky = atmosphere.sky(towards(7.0 * i, i % 181 - 90.0));
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(sky[c]) && sky[c] >= 0);
      ASSERT_TRUE(elevation > -15 || sky.y < 0.3f) << sky.y;
    }
  }
}

TEST(SunGlare, TheDiscOutshinesItsSurroundingsUntilTheCloudIsThick) {
  EXPECT_GT(glare(0.1, 0, 0), 1000);
  EXPECT_LT(glare(1.0, 0, 0), 3);
  EXPECT_GT(glare(0.1, 6, 0), 4 * glare(2.0, 6, 0));
  EXPECT_LT(glare(0.1, 25, 0), 0.01);
}

TEST(SunGlare, IceMakesAHaloOf22DegreesRedWithin) {
  EXPECT_GT(glare(22.4, 0, 0.5f), 1.5 * glare(20.5, 0, 0.5f));
  EXPECT_GT(glare(22.4, 0, 0.5f), 1.5 * glare(27, 0, 0.5f));
  const glm::vec3 inner = glareAndHalo(std::cos(glm::radians(21.5)), 0, 0.5f);
  EXPECT_GT(inner.x, inner.z);
  // Water shows none, and hides it.
  EXPECT_LT(glare(22.4, 0.5f, 0), 0.02);
  EXPECT_LT(glare(22.4, 5, 0.5f), 0.02);
}

TEST(Tone, RisesAndStaysBelowWhite) {
  EXPECT_NEAR(displayed(glm::vec3(0.2140f)).x, 0.5f, 0.001f);
  float last = 0;
  for (float value = 0; value < 50; value += 0.05f) {
    const float shown = displayed(glm::vec3(value)).y;
    EXPECT_GE(shown, last);
    EXPECT_LE(shown, 1);
    last = shown;
  }
  const glm::vec3 red = displayed({5, 1.5f, 0.5f});
  EXPECT_GT(red.x, red.y + 0.05f);
}

}  // namespace
}  // namespace cloudgen::image
