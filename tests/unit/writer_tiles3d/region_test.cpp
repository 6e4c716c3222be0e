// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/region.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace cloudgen::writer::tiles3d {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Region, HoldsWhatWasIncluded) {
  Region region;
  EXPECT_TRUE(region.empty());
  region.include({10, 50, 1000}, 0, 0);
  region.include({12, 49, 3000}, 0, 200);
  const auto [west, south, east, north, lowest, highest] = region.bounds();
  EXPECT_NEAR(west, glm::radians(10.0), 1e-12);
  EXPECT_NEAR(east, glm::radians(12.0), 1e-12);
  EXPECT_NEAR(south, glm::radians(49.0), 1e-12);
  EXPECT_NEAR(north, glm::radians(50.0), 1e-12);
  EXPECT_EQ(lowest, 1000);
  EXPECT_EQ(highest, 3200);
  EXPECT_NEAR(region.center().x, 11, 1e-9);
}

TEST(Region, ReachesSoManyMeters) {
  Region region;
  region.include({20, 60, 0}, 10'000, 0);
  const auto bounds = region.bounds();
  // 10 km are 0.0898 degrees of latitude, and twice that of longitude at 60 degrees.
  EXPECT_NEAR(glm::degrees(bounds[3] - bounds[1]), 2 * 0.0898, 0.002);
  EXPECT_NEAR(glm::degrees(bounds[2] - bounds[0]), 4 * 0.0898, 0.004);
  EXPECT_GT(bounds[5], 7) << "its border rises over the curved ground";
  EXPECT_LT(bounds[5], 9);
}

TEST(Region, CrossesTheAntimeridianTheShortWay) {
  Region region;
  for (const double longitude : {179.0, -178.0, 178.5, -179.5}) region.include({longitude, 0, 0}, 0, 0);
  const auto bounds = region.bounds();
  EXPECT_NEAR(bounds[0], glm::radians(178.5), 1e-12);
  EXPECT_NEAR(bounds[2], glm::radians(-178.0), 1e-12);
  EXPECT_NEAR(region.center().x, -179.75, 1e-9);
}

TEST(Region, GoesAllAroundAtThePole) {
  Region region;
  region.include({30, 89.99, 100}, 5000, 10);
  const auto bounds = region.bounds();
  EXPECT_EQ(bounds[0], -kPi);
  EXPECT_EQ(bounds[2], kPi);
  EXPECT_EQ(bounds[3], kPi / 2);
  Region other;
  other.include({30, 80, 0}, 0, 0);
  other.include(region);
  EXPECT_EQ(other.bounds()[2] - other.bounds()[0], 2 * kPi);
  EXPECT_NEAR(other.bounds()[1], glm::radians(80.0), 1e-12);
}

TEST(Region, AHullHoldsBothParts) {
  // Around the globe in steps: each hull must hold all of the former.
  Region hull;
  for (int step = 0; step < 12; ++step) {
    Region part;
    part.include({-180 + 30 * step, 0, 0}, 500'000, 0);
    hull.include(part);
    const auto bounds = hull.bounds();
    const double width = bounds[2] - bounds[0] + (bounds[2] < bounds[0] ? 2 * kPi : 0);
    EXPECT_GE(glm::degrees(width), std::min(360.0, 30.0 * step));
  }
}

}  // namespace
}  // namespace cloudgen::writer::tiles3d
