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

}  // namespace
}  // namespace cloudgen::motion
