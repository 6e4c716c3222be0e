// SPDX-License-Identifier: Apache-2.0
#include "motion/wind_field.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace cloudgen::motion {
namespace {

constexpr glm::dvec2 kLower{0, 0}, kUpper{96'000, 96'000};

TEST(WindField, OneSampleBlowsEverywhere) {
  const std::vector<WindSample> samples{{{5000, 7000}, 3000, {4, -2}}};
  const WindField wind(kLower, kUpper, samples);
  for (const glm::dvec2& place : {glm::dvec2(5000, 7000), glm::dvec2(90'000, 80'000), glm::dvec2(-1e6, 0)})
    for (const double height : {0.0, 3000.0, 15'000.0}) EXPECT_EQ(wind.at(place, height), glm::vec2(4, -2));
}

TEST(WindField, BetweenHeightsLinear) {
  const std::vector<WindSample> samples{{{5000, 7000}, 2000, {0, 0}}, {{5000, 7000}, 10'000, {20, 0}}};
  const WindField wind(kLower, kUpper, samples);
  EXPECT_NEAR(wind.at({50'000, 5000}, 6000).x, 10, 1e-4);
  EXPECT_NEAR(wind.at({50'000, 5000}, 4500).x, 6.25, 1e-4);
}

TEST(WindField, CalmWithoutSamples) {
  EXPECT_EQ(WindField().at({0, 0}, 0), glm::vec2(0));
  EXPECT_EQ(WindField(kLower, kUpper, {}).at({10, 10}, 100), glm::vec2(0));
}

std::vector<WindSample> vortex() {
  std::vector<WindSample> samples;
  for (int row = 0; row < 96; ++row)
    for (int column = 0; column < 96; ++column) {
      const glm::dvec2 place((column + 0.5) * 1000, (row + 0.5) * 1000), from = place - glm::dvec2(48'000, 48'000);
      samples.push_back({place, 1000, glm::vec2(-from.y, from.x) * 1e-3f});
    }
  return samples;
}

/// In solid rotation the air goes round in a circle, and back by the same way.
TEST(Path, GoesRoundTheVortex) {
  const auto samples = vortex();
  const WindField wind(kLower, kUpper, samples);
  const double round = 2 * 3.14159265358979 / 1e-3;
  const glm::dvec2 place(68'000, 48'000);
  const auto path = pathOf({wind, wind, round}, place, 1000, 8, false);
  ASSERT_EQ(path.size(), 9u);
  EXPECT_LT(glm::distance(path[2], glm::dvec2(48'000, 68'000)), 200);
  EXPECT_LT(glm::distance(path.back(), place), 300);
  const auto back = pathOf({wind, wind, round}, path.back(), 1000, 8, true);
  EXPECT_LT(glm::distance(back[6], path[2]), 300);
}

/// Wind that rises from 0 to 10 m/s carries by its mean.
TEST(Path, TakesTheWindOfItsTime) {
  const WindField calm(kLower, kUpper, {});
  const std::vector<WindSample> samples{{{5000, 7000}, 1000, {10, 0}}};
  const WindField wind(kLower, kUpper, samples);
  const auto path = pathOf({calm, wind, 3600}, {1000, 1000}, 1000, 2, false);
  EXPECT_NEAR(path[1].x, 1000 + 0.25 * 18'000, 1);
  EXPECT_NEAR(path[2].x, 1000 + 18'000, 1);
}

/// Wind around an eye, strongest at 12 km from it, dying off further out.
WindField storm(const glm::dvec2& eye) {
  std::vector<WindSample> samples;
  for (int row = 0; row < 96; ++row)
    for (int column = 0; column < 96; ++column) {
      const glm::dvec2 place((column + 0.5) * 1000, (row + 0.5) * 1000), from = (place - eye) / 12'000.0;
      samples.push_back({place, 1000, glm::vec2(glm::dvec2(from.y, -from.x) * (40 * std::exp(0.5 - 0.5 * glm::dot(from, from))))});
    }
  return {kLower, kUpper, samples};
}

TEST(Pattern, IsSeenToMove) {
  const glm::dvec2 eye(44'000, 52'000), way(11'000, -6'500);
  const WindField before = storm(eye), after = storm(eye + way);
  EXPECT_LT(glm::distance(wayOfPattern(before, after), way), 700);
  EXPECT_LT(glm::distance(wayOfPattern(after, before), -way), 700);
}

TEST(Pattern, StandsStillWhereNoneIsSeen) {
  const std::vector<WindSample> even{{{5000, 7000}, 3000, {20, -2}}}, stronger{{{5000, 7000}, 3000, {24, 0}}};
  const WindField before(kLower, kUpper, even), after(kLower, kUpper, stronger);
  EXPECT_EQ(wayOfPattern(before, before), glm::dvec2(0));
  EXPECT_EQ(wayOfPattern(before, after), glm::dvec2(0));
  EXPECT_EQ(wayOfPattern(storm({48'000, 48'000}), storm({48'000, 48'000})), glm::dvec2(0));
}

/// Halfway the eye is halfway, and around it blows the storm; winds blended in one place have neither.
TEST(Path, TakesTheEyeAlong) {
  const glm::dvec2 eye(36'000, 52'000), way(18'000, -6000);
  const WindField before = storm(eye), after = storm(eye + way);
  const WindBetween moved{before, after, 7200, way}, blended{before, after, 7200};
  const glm::dvec2 halfway = eye + 0.5 * way, beside = halfway + glm::dvec2(0, 12'000);
  EXPECT_LT(glm::length(moved.at(halfway, 1000, 0.5)), 1);
  EXPECT_NEAR(moved.at(beside, 1000, 0.5).x, 40, 1);
  EXPECT_LT(blended.at(beside, 1000, 0.5).x, 36);
  // Air near the eye goes along with it.
  const auto path = pathOf(moved, eye + glm::dvec2(9000, 0), 1000, 24, false);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LT(glm::distance(path[i], eye + static_cast<double>(i) / 24 * way), 14'000);
}

/// The stretches of a way are the way.
TEST(Path, MayBeCut) {
  const WindField before = storm({44'000, 52'000}), after = storm({48'000, 48'000});
  const WindBetween wind{before, after, 3600, {4000, -4000}};
  const glm::dvec2 place(40'000, 40'000);
  const auto whole = pathOf(wind, place, 1000, 8, false), half = pathOf(wind, place, 1000, 4, false, {0, 0.5}),
             rest = pathOf(wind, half.back(), 1000, 4, false, {0.5, 1});
  EXPECT_LT(glm::distance(half.back(), whole[4]), 1);
  EXPECT_LT(glm::distance(rest.back(), whole[8]), 1);
  const auto back = pathOf(wind, rest.back(), 1000, 4, true, {0.5, 1});
  EXPECT_LT(glm::distance(back.back(), half.back()), 20);
}

}  // namespace
}  // namespace cloudgen::motion
