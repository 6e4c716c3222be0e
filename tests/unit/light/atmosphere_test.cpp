// SPDX-License-Identifier: Apache-2.0
#include "light/atmosphere.hpp"

#include <cmath>

namespace cloudgen::light {
namespace {

TEST(Atmosphere, SunlightFromTheZenithIsThinnedAsKnown) {
  // Rayleigh's optical depths with a scale height of 8 km, the aerosol's 0.024, ozone's 15 km of its layer.
  const glm::vec3 found = sunTransmittance(90, 0);
  const double air[] = {5.802e-6, 13.558e-6, 33.1e-6}, ozone[] = {0.650e-6, 1.881e-6, 0.085e-6};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], std::exp(-(air[c] * 8000 + 2e-5 * 1200 + ozone[c] * 15'000)), 0.01) << c;
}

TEST(Atmosphere, LowSunIsRedAndNightHasNone) {
  double redness = 0;
  for (const double elevation : {90.0, 40.0, 20.0, 10.0, 5.0, 2.0, 0.5}) {
    const glm::vec3 sun = sunTransmittance(elevation, 0);
    EXPECT_GT(sun.r / sun.b, redness);
    redness = sun.r / sun.b;
  }
  EXPECT_GT(redness, 20);
  EXPECT_EQ(sunTransmittance(-0.5, 0), glm::vec3(0));
  // 3 km up the horizon lies 1.76 degrees down.
  EXPECT_GT(sunTransmittance(-1.2, 3000).r, 0.01f);
  EXPECT_EQ(sunTransmittance(-1.9, 3000), glm::vec3(0));
}

TEST(Atmosphere, SkyIsBlueAboveAndWhiteAtTheHorizon) {
  const glm::vec3 zenith = skyRadiance(70, 90, 50), horizon = skyRadiance(4, 90, 50);
  EXPECT_GT(zenith.b, 3 * zenith.r);
  EXPECT_GT(horizon.r / horizon.b, 1.7f * zenith.r / zenith.b);
  EXPECT_GT(horizon.g, zenith.g);
}

TEST(Atmosphere, SunsetIsRedTowardsTheSunAndTwilightBlueAbove) {
  const glm::vec3 glow = skyRadiance(4, 0, 1), above = skyRadiance(70, 0, 1), dusk = skyRadiance(70, 0, -4);
  EXPECT_GT(glow.r, 2 * glow.b);
  EXPECT_GT(above.b, above.r);
  EXPECT_GT(dusk.b, dusk.r);
  EXPECT_LT(dusk.b, 0.2f * above.b);
  EXPECT_GT(dusk.b, 0);
}

}  // namespace
}  // namespace cloudgen::light
