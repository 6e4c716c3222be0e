// SPDX-License-Identifier: Apache-2.0
#include "light/sky.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace cloudgen::light {
namespace {

double apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

TEST(Sun, StandsOverheadOnTheTropicAtTheSolstice) {
  const Sun sun = sunAt(base::utcFromCivil(2026, 6, 21, 12), 0, 23.44);
  EXPECT_GT(sun.elevationDegrees, 89.4);
  EXPECT_GT(sun.direction.y, 0.9999f);
}

// At the equinox the sun passes the zenith of the equator; the equation of time is then -7.5 minutes.
TEST(Sun, EquinoxOnTheEquator) {
  EXPECT_GT(sunAt(base::utcFromCivil(2026, 3, 20, 12, 7, 30), 0, 0).elevationDegrees, 89.8);
  const Sun rising = sunAt(base::utcFromCivil(2026, 3, 20, 6, 7, 30), 0, 0);
  EXPECT_NEAR(rising.elevationDegrees, 0, 0.2);
  EXPECT_NEAR(rising.azimuthDegrees, 90, 0.3);
  EXPECT_GT(rising.direction.x, 0.99f);
  const Sun setting = sunAt(base::utcFromCivil(2026, 3, 20, 18, 7, 30), 0, 0);
  EXPECT_NEAR(setting.azimuthDegrees, 270, 0.3);
  EXPECT_LT(setting.direction.x, -0.99f);
}

// Reda & Andreas 2004, the worked example of the solar position algorithm (no refraction).
TEST(Sun, WorkedExampleOfTheSolarPositionAlgorithm) {
  const Sun sun = sunAt(base::utcFromCivil(2003, 10, 17, 19, 30, 30), -105.1786, 39.742476);
  EXPECT_NEAR(sun.elevationDegrees, 39.872, 0.02);
  EXPECT_NEAR(sun.azimuthDegrees, 194.340, 0.02);
}

TEST(Sun, NoonIsInTheSouthInTheNorthAndInTheNorthInTheSouth) {
  const base::UtcTime noon = base::utcFromCivil(2026, 6, 21, 12, 2);
  const Sun north = sunAt(noon, 0, 50), south = sunAt(noon, 0, -40);
  EXPECT_LT(apart(north.azimuthDegrees, 180), 0.5);
  EXPECT_NEAR(north.elevationDegrees, 90 - 50 + 23.44, 0.05);
  EXPECT_GT(north.direction.z, 0.4f);
  EXPECT_LT(apart(south.azimuthDegrees, 0), 0.5);
  EXPECT_NEAR(south.elevationDegrees, 90 - 40 - 23.44, 0.05);
}

TEST(Sun, DirectionFollowsAzimuthAndElevation) {
  const Sun sun = sunFrom(90, 30);
  EXPECT_LT(glm::distance(sun.direction, glm::vec3(std::sqrt(0.75f), 0.5f, 0)), 1e-5f);
  EXPECT_LT(glm::distance(sunFrom(0, 0).direction, glm::vec3(0, 0, -1)), 1e-5f);
  for (const double elevation : {-90.0, -20.0, 0.0, 5.0, 90.0})
    EXPECT_NEAR(glm::length(sunFrom(123, elevation).direction), 1, 1e-5);
}

TEST(Sun, IsRedderAndDimmerTheLowerItStands) {
  float redness = 0, brightness = 10;
  for (const double elevation : {90.0, 60.0, 30.0, 15.0, 8.0, 3.0}) {
    const Sun sun = sunFrom(180, elevation);
    EXPECT_GE(sun.color.r / sun.color.b, redness);
    EXPECT_LE(sun.color.g, brightness);
    redness = sun.color.r / sun.color.b;
    brightness = sun.color.g;
  }
  EXPECT_NEAR(sunFrom(180, 90).color.r / sunFrom(180, 90).color.b, 1, 0.02);
  EXPECT_GT(redness, 3);
}

TEST(Sky, IsBlueByDayWarmAtSunsetAndDarkAtNight) {
  const Sky noon = skyUnder(sunFrom(180, 60)), sunset = skyUnder(sunFrom(270, 1)),
            night = skyUnder(sunFrom(0, -40));
  EXPECT_GT(noon.zenith.b, noon.zenith.r);
  EXPECT_GT(sunset.horizon.r, sunset.horizon.b);
  EXPECT_LT(night.zenith.b, 0.1f * noon.zenith.b);
  for (const Sky& sky : {noon, sunset, night})
    for (const glm::vec3& color : {sky.zenith, sky.horizon, sky.ground, sky.ambient, sky.bounce})
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(color[c], 0);
        EXPECT_LE(color[c], 1);
      }
}

}  // namespace
}  // namespace cloudgen::light
