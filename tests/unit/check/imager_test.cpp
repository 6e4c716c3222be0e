// SPDX-License-Identifier: Apache-2.0
// Blobs whose cover and optical depth are known by hand.
#include "check/fidelity/imager.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "check/fidelity/height_profile.hpp"

namespace cloudgen::check {
namespace {

/// Rays on a lattice over a square of `side` metres about the origin.
std::vector<glm::dvec2> raysOver(double side, int across = 200) {
  std::vector<glm::dvec2> rays;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column)
      rays.emplace_back(((column + 0.5) / across - 0.5) * side, ((row + 0.5) / across - 0.5) * side);
  return rays;
}

glm::mat3 stretched(const glm::quat& turn, const glm::vec3& sigma) {
  glm::mat3 axes = glm::mat3_cast(turn);
  for (int i = 0; i < 3; ++i) axes[i] *= sigma[i];
  return axes;
}

Footprint volume(const glm::vec3& center, const glm::mat3& halfAxes, float frontalOpticalDepth) {
  return footprintOf(volumeBlob(center, halfAxes, frontalOpticalDepth), {}, {});
}

Footprint card(const glm::vec3& center, const glm::vec3& right, const glm::vec3& up, float opticalDepth) {
  return footprintOf(cardBlob(center, right, up, opticalDepth), {}, {});
}

ColumnView look(const std::vector<Footprint>& footprints, double side, const ModelColumn& column = {}) {
  return Imager(footprints).look(raysOver(side), column);
}

TEST(Imager, ABallCoversACircleAndHoldsItsIntegral) {
  const double sigma = 100, depth = 5, side = 1000;
  const auto seen = look({volume({0, 1000, 0}, glm::mat3(100), depth)}, side);
  EXPECT_NEAR(seen.opticalDepth, 2 * std::numbers::pi * sigma * sigma * depth / (side * side), 0.002);
  // As it is blended: where the opacity at the centre times the Gaussian is that of the limit.
  const double drawn =
      sigma * std::sqrt(2 * std::log(-std::expm1(-depth) / -std::expm1(-kCloudyOpticalDepth)));
  EXPECT_NEAR(seen.cover, std::numbers::pi * drawn * drawn / (side * side), 0.002);
  EXPECT_EQ(seen.coverIn[0], seen.cover);
  EXPECT_EQ(seen.coverIn[1] + seen.coverIn[2], 0);
}

TEST(Imager, ATurnedBlobHoldsTheSameIntegral) {
  // The integral over space does not change by turning: extinction (2 pi)^1.5 s1 s2 s3.
  const glm::vec3 sigma(150, 40, 80);
  const double frontal = 2, side = 1600;
  const double whole = frontal / 40 * 2 * std::numbers::pi * 150 * 40 * 80 / (side * side);
  for (const float angle : {0.0f, 0.4f, 1.1f, 1.5f}) {
    const auto axes = stretched(glm::angleAxis(angle, glm::normalize(glm::vec3(1, 0.3f, 0.5f))), sigma);
    EXPECT_NEAR(look({volume({30, 1000, -50}, axes, frontal)}, side).opticalDepth / whole, 1, 0.01) << angle;
  }
}

TEST(Imager, CloudsAboveEachOtherAddUpAndPartByHeight) {
  const std::vector<Footprint> footprints{volume({0, 1000, 0}, glm::mat3(100), 3),
                                          volume({0, 4000, 0}, glm::mat3(100), 1),
                                          volume({350, 9000, 0}, glm::mat3(50), 1)};
  const ColumnView seen = look(footprints, 1000);
  const double area = 1e6;
  const auto circle = [&](double sigma, double depth) {
    return std::numbers::pi * sigma * sigma * 2 *
           std::log(-std::expm1(-depth) / -std::expm1(-kCloudyOpticalDepth)) / area;
  };
  EXPECT_NEAR(seen.coverIn[0], circle(100, 3), 0.002);
  EXPECT_NEAR(seen.coverIn[1], circle(100, 1), 0.002);
  EXPECT_NEAR(seen.coverIn[2], circle(50, 1), 0.002);
  EXPECT_NEAR(seen.opticalDepth, 2 * std::numbers::pi * (1e4 * 3 + 1e4 + 2500) / area, 0.002);
}

TEST(Imager, FindsBaseAndTop) {
  ModelColumn column;
  const ColumnView seen = look({volume({0, 1500, 0}, glm::mat3(100), 8)}, 1000, column);
  EXPECT_NEAR(seen.baseMeters.value(), 1500 - 164.5, 20);
  EXPECT_NEAR(seen.topMeters.value(), 1500 + 164.5, 20);
}

TEST(Imager, ALeaningBlobIsHigherOnOneSide) {
  const auto axes = stretched(glm::angleAxis(0.5f, glm::vec3(0, 0, 1)), {300, 30, 300});
  const Footprint footprint = volume({0, 1000, 0}, axes, 1);
  EXPECT_NEAR(footprint.heightSlope.x, std::tan(0.5), 0.02);
  EXPECT_NEAR(footprint.heightSlope.y, 0, 1e-6);
  EXPECT_LT(footprint.heightDeviation, 40);
}

TEST(Imager, ACardEndsAtItsBorder) {
  const ColumnView seen = look({card({0, 500, 0}, {100, 0, 0}, {0, 0, -50}, 10)}, 1000);
  const double within = 1 - std::exp(-0.5 * 2.2 * 2.2);
  EXPECT_NEAR(seen.opticalDepth, 10 * 2 * std::numbers::pi * 100 * 50 * within / 1e6, 0.002);
  EXPECT_FALSE(isSeen(card({0, 500, 0}, {100, 0, 0}, {0, 50, 0}, 10)));
}

TEST(Imager, NothingIsSeenOfNothing) {
  const ColumnView seen = look({}, 1000);
  EXPECT_EQ(seen.cover, 0);
  EXPECT_FALSE(seen.baseMeters.has_value());
}

TEST(HeightProfile, FindsSharesOfWhatLiesBetween) {
  HeightProfile profile;
  profile.addUniform(1000, 2000, 10);
  profile.addUniform(5000, 6000, 1);
  EXPECT_NEAR(profile.heightAt(0.5, -500, 22000).value(), 1550, 1);
  EXPECT_NEAR(profile.heightAt(0.5, 3000, 22000).value(), 5500, 1);
  EXPECT_NEAR(profile.heightAt(0.05, 0, 3000).value(), 1050, 1);
  EXPECT_NEAR(profile.between(1500, 5500), 5.5, 1e-9);
  EXPECT_FALSE(profile.heightAt(0.5, 7000, 8000).has_value());
}

}  // namespace
}  // namespace cloudgen::check
