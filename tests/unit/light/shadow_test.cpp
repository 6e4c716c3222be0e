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
  const auto sunlight = sunlightOf(clouds, {0, 1, 0});
  EXPECT_EQ(sunlight[0], 1);
  EXPECT_NEAR(sunlight[1], transmitted((1 - kWaterAsymmetry) * 15), 0.02);
  EXPECT_EQ(sunlight[2], 1);
}

TEST(Shadow, FallsAwayFromTheSun) {
  // A small cloud 3000 m above the tops of two others, the sun in the east at 45 degrees.
  const std::vector<Caster> clouds{
      {{0, 4700, 0}, 900, 200, 10}, cumulusAt(0, 0), cumulusAt(-3100, 0), cumulusAt(3100, 0)};
  const auto sunlight = sunlightOf(clouds, sunFrom(90, 45).direction);
  EXPECT_EQ(sunlight[1], 1);
  EXPECT_LT(sunlight[2], 0.6f);
  EXPECT_EQ(sunlight[3], 1);
}

TEST(Shadow, ATowerShadesItsNeighbourAtSunsetButNotItself) {
  const std::vector<Caster> clouds{
      {{0, 1000, 0}, 3000, 10'000, 100}, cumulusAt(-9000, 0), cumulusAt(9000, 0)};
  const auto sunlight = sunlightOf(clouds, sunFrom(270, 20).direction);
  EXPECT_EQ(sunlight[0], 1);
  EXPECT_EQ(sunlight[1], 1);
  EXPECT_LT(sunlight[2], 0.5f);
}

TEST(Shadow, WhatIsTakenDoesNotHangOnTheCells) {
  // The same field near, and in a scene so wide that a cell holds a whole cloud.
  std::vector<Caster> clouds{{{0, 5000, 0}, 4000, 100, 4}, {{0, 1000, 0}, 4000, 100, 4}};
  const float near = sunlightOf(clouds, {0, 1, 0})[1];
  clouds.push_back({{6'000'000, 500, 0}, 100, 100, 1});
  const float wide = sunlightOf(clouds, {0, 1, 0})[1];
  EXPECT_NEAR(near, wide, 0.1f);
}

TEST(Shadow, StaysInBoundsForEverySun) {
  const std::vector<Caster> clouds{{{0, 3000, 0}, 5000, 500, 200}, cumulusAt(0, 0), {{0, 0, 0}, 0, 0, 0}};
  for (const double elevation : {-30.0, 0.0, 2.0, 90.0})
    for (const float share : sunlightOf(clouds, sunFrom(200, elevation).direction)) {
      EXPECT_TRUE(std::isfinite(share));
      EXPECT_TRUE(share >= 0 && share <= 1) << share;
    }
  EXPECT_TRUE(sunlightOf({}, {0, 1, 0}).empty());
}

}  // namespace
}  // namespace cloudgen::light
