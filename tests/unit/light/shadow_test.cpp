// SPDX-License-Identifier: Apache-2.0
#include "light/shadow.hpp"

#include <cmath>

#include "light/octaves.hpp"
#include "light/optics.hpp"
#include "light/sky.hpp"

namespace cloudgen::light {
namespace {

Caster cumulusAt(float x, float z) { return {{x, 1000, z}, 400, 700, 20}; }

TEST(Shadow, ADeckShadesWhatLiesUnderIt) {
  const std::vector<Caster> clouds{{{0, 3000, 0}, 10'000, 500, 15}, cumulusAt(0, 0), cumulusAt(20'000, 0)};
  const auto sunlight = shadowsOf(clouds, {0, 1, 0}).sunlight;
  EXPECT_EQ(sunlight[0], 1);
  EXPECT_NEAR(sunlight[1], transmitted((1 - kWaterAsymmetry) * 15), 0.02);
  EXPECT_EQ(sunlight[2], 1);
}

TEST(Shadow, FallsAwayFromTheSun) {
  // A small cloud 3000 m above the tops of two others, the sun in the east at 45 degrees.
  const std::vector<Caster> clouds{
      {{0, 4700, 0}, 900, 200, 10}, cumulusAt(0, 0), cumulusAt(-3100, 0), cumulusAt(3100, 0)};
  const auto sunlight = shadowsOf(clouds, sunFrom(90, 45).direction).sunlight;
  EXPECT_EQ(sunlight[1], 1);
  EXPECT_LT(sunlight[2], 0.6f);
  EXPECT_EQ(sunlight[3], 1);
}

TEST(Shadow, ATowerShadesItsNeighbourAtSunsetButNotItself) {
  const std::vector<Caster> clouds{
      {{0, 1000, 0}, 3000, 10'000, 100}, cumulusAt(-9000, 0), cumulusAt(9000, 0)};
  const auto sunlight = shadowsOf(clouds, sunFrom(270, 20).direction).sunlight;
  EXPECT_EQ(sunlight[0], 1);
  EXPECT_EQ(sunlight[1], 1);
  EXPECT_LT(sunlight[2], 0.5f);
}

TEST(Shadow, WhatIsTakenDoesNotHangOnTheCells) {
  // The same field near, and in a scene so wide that a cell holds a whole cloud.
  std::vector<Caster> clouds{{{0, 5000, 0}, 4000, 100, 4}, {{0, 1000, 0}, 4000, 100, 4}};
  const float near = shadowsOf(clouds, {0, 1, 0}).sunlight[1];
  clouds.push_back({{6'000'000, 500, 0}, 100, 100, 1});
  const float wide = shadowsOf(clouds, {0, 1, 0}).sunlight[1];
  EXPECT_NEAR(near, wide, 0.1f);
}

TEST(Shadow, OnTheGroundFallsWhereTheSunIsHidden) {
  const std::vector<Caster> clouds{cumulusAt(0, 0)};
  const ShadowPlane plane = shadowsOf(clouds, sunFrom(90, 45).direction).whole;
  // The cloud's middle is 1350 m up, so its shadow lies as far to the west; from a hill it is met earlier.
  EXPECT_NEAR(plane.opticalDepthTo({-1350, 0, 0}), 20 * std::sqrt(2.0f), 2);
  EXPECT_NEAR(plane.opticalDepthTo({-850, 500, 0}), 20 * std::sqrt(2.0f), 2);
  EXPECT_EQ(plane.opticalDepthTo({0, 0, 0}), 0);
  EXPECT_EQ(plane.opticalDepthTo({1e7, 0, 1e7}), 0);
  EXPECT_EQ(ShadowPlane().opticalDepthTo({0, 0, 0}), 0);
}

TEST(Shadow, StaysInBoundsForEverySun) {
  const std::vector<Caster> clouds{{{0, 3000, 0}, 5000, 500, 200}, cumulusAt(0, 0), {{0, 0, 0}, 0, 0, 0}};
  for (const double elevation : {-30.0, 0.0, 2.0, 90.0})
    for (const float share : shadowsOf(clouds, sunFrom(200, elevation).direction).sunlight) {
      EXPECT_TRUE(std::isfinite(share));
      EXPECT_TRUE(share >= 0 && share <= 1) << share;
    }
  EXPECT_TRUE(shadowsOf({}, {0, 1, 0}).sunlight.empty());
}

}  // namespace
}  // namespace cloudgen::light
