// SPDX-License-Identifier: Apache-2.0
#include "light/moon.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace cloudgen::light {
namespace {

// Meeus 1998, examples 47.a and 48.a: 1992 April 12, 0h TD.
TEST(Moon, PhaseOfMeeusExample) {
  EXPECT_NEAR(moonAt(base::utcFromCivil(1992, 4, 12), 0, 0).phaseAngleDegrees, 69.08, 0.5);
}

// The total eclipse of 2024 April 8 over Torreon, Mexico, at its greatest: the moon stands before the sun.
TEST(Moon, StandsBeforeTheSunInAnEclipse) {
  const base::UtcTime time = base::utcFromCivil(2024, 4, 8, 18, 17);
  const Moon moon = moonAt(time, -104.1, 25.3);
  EXPECT_GT(glm::dot(moon.direction, sunAt(time, -104.1, 25.3).direction), std::cos(0.2 * 3.14159 / 180));
  EXPECT_GT(moon.phaseAngleDegrees, 178);
}

// The moon was full on 2026 January 3 at 10:03 UTC: it stands opposite to the sun.
TEST(Moon, IsFullOppositeToTheSun) {
  const base::UtcTime time = base::utcFromCivil(2026, 1, 3, 10, 3);
  const Moon moon = moonAt(time, -150, 20);
  EXPECT_LT(moon.phaseAngleDegrees, 6);
  EXPECT_LT(glm::dot(moon.direction, sunAt(time, -150, 20).direction), -0.99f);
  EXPECT_GT(moon.elevationDegrees, 70);
}

// Krisciunas & Schaefer 1991; a full moon at the zenith gives 0.25 to 0.32 lux, a half moon about a tenth.
TEST(Moon, IlluminanceFallsSteeplyFromFullMoon) {
  EXPECT_NEAR(moonIlluminanceLux(0), 0.31, 0.02);
  EXPECT_NEAR(moonIlluminanceLux(90) / moonIlluminanceLux(0), 0.09, 0.02);
  EXPECT_LT(moonIlluminanceLux(150), 0.003);
}

Moon moonOf(double elevationDegrees, double phaseAngleDegrees) {
  const Sun placed = sunFrom(120, elevationDegrees);
  return {120, elevationDegrees, phaseAngleDegrees, placed.direction};
}

TEST(Moon, NightsAreTheBrighterTheMoreMoonThereIs) {
  const float none = moonlightUnder(moonOf(-20, 0)), half = moonlightUnder(moonOf(90, 90)),
              full = moonlightUnder(moonOf(90, 0));
  EXPECT_NEAR(half, 1, 0.03);
  EXPECT_GT(full, 2 * half);
  EXPECT_LT(none, 0.4f * half);
  EXPECT_GT(none, 0.2f * half);  // stars and air
  const Sun set = sunFrom(0, -40);
  EXPECT_GT(skyUnder(set, full).zenith.b, 2 * skyUnder(set, half).zenith.b);
  EXPECT_LT(skyUnder(set, full).zenith.b, 0.1f * skyUnder(sunFrom(180, 40)).zenith.b);
  EXPECT_EQ(skyUnder(sunFrom(180, 40), none).moonlight, none);
}

TEST(Moon, LightsCloudsOnceTheSunIsDown) {
  const Moon moon = moonOf(45, 20);
  const Sun set = sunFrom(270, -15), up = sunFrom(270, 15);
  EXPECT_EQ(keyLight(set, moon, 1000).direction, moon.direction);
  EXPECT_EQ(keyLight(up, moon, 1000).direction, up.direction);
  const glm::vec3 color = keyLight(set, moon, 1000).color;
  EXPECT_GT(color.g, 0.005f);
  EXPECT_LT(color.g, 0.05f);
  EXPECT_EQ(keyLight(set, moonOf(-10, 0), 1000).color, glm::vec3(0));
}

}  // namespace
}  // namespace cloudgen::light
