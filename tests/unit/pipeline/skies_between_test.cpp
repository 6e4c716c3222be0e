// SPDX-License-Identifier: Apache-2.0
#include "pipeline/skies_between.hpp"

#include <gtest/gtest.h>

namespace cloudgen::pipeline {
namespace {

constexpr glm::dvec2 kLower{0, 0}, kUpper{100'000, 100'000};

/// A cloud a cell of 5 km, each with its turn.
CloudsOfTime evenClouds(float width) {
  CloudsOfTime time{{}, {}, {}, kLower, kUpper};
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) {
      time.clouds.push_back({{5000.0 * column + 2500, 5000.0 * row + 2500}, width, 1000, 1000, base::Genus::Cumulus});
      time.turns.push_back(static_cast<float>((row * 20 + column) * 7 % 400) / 400.0f);
      time.fractions.push_back(0.5f);
    }
  return time;
}

motion::WindField evenWind(float east) {
  const std::vector<motion::WindSample> samples{{{50'000, 50'000}, 1000, {east, 0}}};
  return {kLower, kUpper, samples};
}

TEST(SkiesBetween, TimeIsCutOnlyWhereTheAirOfTheBoxIsAnother) {
  const CloudsOfTime clouds = evenClouds(2000);
  const auto stretches = [&](float east) {
    const motion::WindField wind = evenWind(east);
    return stretchesBetween(clouds, clouds, {wind, wind, 3600});
  };
  EXPECT_EQ(stretches(0), 1);
  EXPECT_EQ(stretches(10), 1) << "36 of 100 km";
  EXPECT_EQ(stretches(20), 3) << "72 of 100 km, 24 in a third of the time";
  EXPECT_EQ(stretches(150), kMostStretches);
  EXPECT_EQ(stretchesBetween({{}, {}, {}, kLower, kUpper}, {{}, {}, {}, kLower, kUpper}, {evenWind(150), evenWind(150), 3600}), 1);
}

TEST(SkiesBetween, CellsTurnOneAfterAnother) {
  const CloudsOfTime earlier = evenClouds(2000), later = evenClouds(3000);
  const auto skies = skiesBetween(earlier, later, glm::dvec2(0), 4);
  ASSERT_EQ(skies.size(), 3u);
  for (const SkyBetween& sky : skies) {
    ASSERT_EQ(sky.origins.size(), earlier.clouds.size()) << "a cloud a cell, of the one time or the other";
    std::size_t turned = 0;
    for (std::size_t i = 0; i < sky.origins.size(); ++i) {
      turned += sky.origins[i].later;
      EXPECT_EQ(sky.clouds.clouds[i].widthMeters, sky.origins[i].later ? 3000 : 2000);
    }
    EXPECT_NEAR(static_cast<double>(turned) / 400, sky.share, 0.01);
  }
}

TEST(SkiesBetween, CloudsStandWhereThePatternTakesThem) {
  const CloudsOfTime clouds = evenClouds(2000);
  const auto skies = skiesBetween(clouds, clouds, glm::dvec2(8000, -4000), 4);
  for (std::size_t i = 0; i < skies[0].origins.size(); ++i) {
    const auto& origin = skies[0].origins[i];
    EXPECT_EQ(origin.shift, origin.later ? glm::dvec2(-6000, 3000) : glm::dvec2(2000, -1000));
    EXPECT_EQ(skies[0].clouds.clouds[i].place, clouds.clouds[origin.cloud].place + origin.shift);
  }
}

}  // namespace
}  // namespace cloudgen::pipeline
