// SPDX-License-Identifier: Apache-2.0
#include "field/cloud_water.hpp"

#include <cmath>

namespace cloudgen::field {
namespace {

TEST(Air, DensityOfTheStandardAtmosphere) {
  EXPECT_NEAR(airDensity(101325, 288.15, 0), 1.2250, 2e-4);
  EXPECT_LT(airDensity(101325, 288.15, 0.02), airDensity(101325, 288.15, 0)) << "moist air is lighter";
}

TEST(Air, SaturationAtKnownTemperatures) {
  EXPECT_NEAR(saturationVapourPressure(293.15), 2337, 3);
  EXPECT_NEAR(saturationSpecificHumidity(101325, 293.15), 0.01447, 2e-5);
  EXPECT_NEAR(saturationVapourPressure(233.15), 12.84, 0.1) << "over ice";
  EXPECT_GT(saturationSpecificHumidity(100, 300), 0) << "thin air does not divide by zero";
  EXPECT_LE(saturationSpecificHumidity(100, 300), 1);
}

TEST(Air, DewPointIsTheTemperatureWhenSaturated) {
  EXPECT_NEAR(dewPoint(285, 1), 285, 1e-9);
  EXPECT_NEAR(dewPoint(293.15, 0.5), 273.15 + 9.27, 0.05);
  EXPECT_TRUE(std::isfinite(dewPoint(293.15, 0)));
}

TEST(CloudWater, TurnsToIceBetweenZeroAndMinus23) {
  EXPECT_EQ(liquidShare(280), 1);
  EXPECT_EQ(liquidShare(273.16), 1);
  EXPECT_NEAR(liquidShare(261.66), 0.25, 1e-12);
  EXPECT_EQ(liquidShare(250.16), 0);
  EXPECT_EQ(liquidShare(200), 0);
}

TEST(CloudWater, DropletsByHand) {
  // 0.3 g/m3: r^3 = 3 LWC / (4 pi rho k N) = 9.301e-16 m3.
  EXPECT_NEAR(liquidEffectiveRadius(3e-4), 9.761e-6, 2e-9);
  EXPECT_NEAR(liquidExtinction(3e-4), 0.04610, 2e-5);
  EXPECT_DOUBLE_EQ(liquidEffectiveRadius(1e-6), 4e-6);
  EXPECT_DOUBLE_EQ(liquidEffectiveRadius(1e-2), 30e-6);
  EXPECT_EQ(liquidExtinction(0), 0);
  EXPECT_EQ(liquidExtinction(std::nan("")), 0);
}

TEST(CloudWater, IceByHand) {
  // 0.01 g/m3 at -40 C: D = (16.557 + 37.14) * 0.8151 um.
  EXPECT_NEAR(iceEffectiveRadius(1e-5, 233.15), 28.43e-6, 2e-8);
  EXPECT_NEAR(iceExtinction(1e-5, 233.15), 5.754e-4, 1e-6);
  EXPECT_DOUBLE_EQ(iceEffectiveRadius(1e-9, 150), iceEffectiveRadius(1e-7, 203.15))
      << "held where the fit holds";
  EXPECT_DOUBLE_EQ(iceEffectiveRadius(1e-2, 300), iceEffectiveRadius(3e-4, 268.15));
}

TEST(CloudFraction, XuRandallByHandAndWithinItsBounds) {
  EXPECT_NEAR(cloudFractionXuRandall(0.8, 1e-4, 0.01), 0.1792, 2e-4);
  EXPECT_EQ(cloudFractionXuRandall(1.02, 1e-5, 0.01), 1);
  EXPECT_EQ(cloudFractionXuRandall(0.9, 0, 0.01), 0);
  EXPECT_EQ(cloudFractionXuRandall(0.9, -1e-5, 0.01), 0);
  EXPECT_EQ(cloudFractionXuRandall(0.2, 1e-7, 0.01), 0) << "under 0.01";
  for (double humidity = 0; humidity <= 1.2; humidity += 0.05)
    for (double condensate = 1e-7; condensate < 1e-2; condensate *= 3) {
      const double fraction = cloudFractionXuRandall(humidity, condensate, 0.005);
      EXPECT_GE(fraction, 0);
      EXPECT_LE(fraction, 1);
      EXPECT_GE(cloudFractionXuRandall(humidity, condensate * 1.1, 0.005), fraction)
          << "more water, more cloud";
    }
}

TEST(Height, GeopotentialMetresAreLongerAtTheEquator) {
  EXPECT_NEAR(geometricHeight(10000, 45), 10016.2, 0.5);
  EXPECT_NEAR(geometricHeight(10000, 0), 10042.8, 0.5);
  EXPECT_NEAR(geometricHeight(0, 30), 0, 1e-9);
}

}  // namespace
}  // namespace cloudgen::field
