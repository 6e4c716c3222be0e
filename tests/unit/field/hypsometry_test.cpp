// SPDX-License-Identifier: Apache-2.0
#include "field/hypsometry.hpp"

#include <gtest/gtest.h>

#include "field/cloud_water.hpp"
#include "field/standard_atmosphere.hpp"
#include "unit/field/made_levels.hpp"

namespace cloudgen::field {
namespace {

TEST(Hypsometry, IsothermalAirByHand) {
  // 287.06 / 9.80665 * 250 * ln 2
  EXPECT_NEAR(thickness(80000, 40000, 250), 5072.4, 0.5);
  EXPECT_NEAR(pressureAfter(80000, thickness(80000, 40000, 250), 250), 40000, 1e-6);
  EXPECT_NEAR(meanVirtualTemperature(80000, 40000, thickness(80000, 40000, 250)), 250, 1e-9);
  EXPECT_NEAR(pressureAfter(40000, -thickness(80000, 40000, 250), 250), 80000, 1e-6);
}

TEST(Hypsometry, MoistAirIsThicker) {
  EXPECT_NEAR(virtualTemperature(300, 0.02), 300 * (1 + 0.6077 * 0.02), 0.01);
  EXPECT_NEAR(temperatureFromVirtual(virtualTemperature(280, 0.01), 0.01), 280, 1e-9);
  EXPECT_DOUBLE_EQ(virtualTemperature(280, kNan), 280);
}

TEST(Hypsometry, StepsOf25HectopascalsFollowAConstantLapseRateWithinAMeter) {
  const AnalyticAir air;
  double height = air.heightOf(100000);
  for (int pressure = 100000; pressure > 20000; pressure -= 2500) {
    const double low = 290 - 0.0065 * air.heightOf(pressure);
    const double high = 290 - 0.0065 * air.heightOf(pressure - 2500);
    height += thickness(pressure, pressure - 2500, 0.5 * (low + high));
  }
  EXPECT_NEAR(height, air.heightOf(20000), 1.0) << "at " << height << " gpm";
}

TEST(Hypsometry, FromTheGroundWithTheStandardLapseRate) {
  const AnalyticAir air;
  EXPECT_NEAR(thicknessFromGround(101000, 85000, 290 - 0.0065 * air.heightOf(85000)), air.heightOf(85000), 1);
  EXPECT_NEAR(pressureFromGround(101000, air.heightOf(85000), 290 - 0.0065 * air.heightOf(85000)), 85000, 5);
}

TEST(StandardAtmosphere, HasTheIcaoValues) {
  EXPECT_NEAR(standardPressure(0), 101325, 0.1);
  EXPECT_NEAR(standardPressure(5000), 54019.9, 6);
  EXPECT_NEAR(standardPressure(11000), 22632.1, 3);
  EXPECT_NEAR(standardPressure(20000), 5474.9, 1);
  EXPECT_NEAR(standardPressure(30000), 1171.9, 1);
  EXPECT_NEAR(standardTemperature(15000), 216.65, 1e-9);
  EXPECT_NEAR(standardTemperature(25000), 221.65, 1e-9);
  for (const double height : {-400.0, 0.0, 3000.0, 10999.0, 15000.0, 25000.0, 40000.0})
    EXPECT_NEAR(standardHeight(standardPressure(height)), height, 3);
  EXPECT_TRUE(std::isnan(standardHeight(0)));
}

TEST(StandardAtmosphere, GeopotentialAndGeometricHeightAreInverse) {
  for (const double latitude : {-80.0, 0.0, 45.0})
    for (const double height : {-100.0, 0.0, 1500.0, 12000.0})
      EXPECT_NEAR(geometricHeight(geopotentialHeight(height, latitude), latitude), height, 1e-6);
}

}  // namespace
}  // namespace cloudgen::field
