// SPDX-License-Identifier: Apache-2.0
// Models that tell humidity but no cloud water.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "field/cloud_water.hpp"
#include "unit/field/made_levels.hpp"

namespace cloudgen::field {
namespace {

/// The analytic air with relative humidity only: 95 % on the four levels, 40 % elsewhere.
struct HumidAir : AnalyticAir {
  HumidAir() {
    for (Level& level : levels) {
      const bool cloudy = level.of(Quantity::CloudLiquid)[0] > 0;
      level.values[Quantity::RelativeHumidity] = {cloudy ? 0.95f : 0.4f};
      for (const Quantity gone : {Quantity::CloudLiquid, Quantity::CloudFraction, Quantity::SpecificHumidity})
        level.values.erase(gone);
    }
  }
};

TEST(HumidityClouds, CriticalHumidityFallsFromTheGroundUpwards) {
  EXPECT_NEAR(criticalRelativeHumidity(100000, 100000), 0.9, 1e-12);
  EXPECT_NEAR(criticalRelativeHumidity(110000, 100000), 0.9, 1e-12);
  EXPECT_NEAR(criticalRelativeHumidity(80000, 100000), 0.7 + 0.2 * std::exp(1 - 1 / 0.4096), 1e-12);
  EXPECT_NEAR(criticalRelativeHumidity(30000, 100000), 0.7, 1e-6);
}

TEST(HumidityClouds, SundqvistByHand) {
  EXPECT_DOUBLE_EQ(cloudFractionSundqvist(0.7, 0.7), 0);
  EXPECT_DOUBLE_EQ(cloudFractionSundqvist(kNan, 0.7), 0);
  EXPECT_NEAR(cloudFractionSundqvist(0.925, 0.7), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(cloudFractionSundqvist(1.02, 0.7), 1);
}

TEST(HumidityClouds, WaterFallsWithHeight) {
  EXPECT_NEAR(diagnosedCloudWater(0, 20), 0.21e-3, 1e-9);
  const double scale = 700 * std::log(21.0);
  EXPECT_NEAR(diagnosedCloudWater(scale, 20), 0.21e-3 / std::exp(1.0), 1e-9);
  EXPECT_GE(diagnosedCloudWater(1000, 0), 0);
}

TEST(HumidityClouds, FractionAndWaterAreDerivedAndSaidToBe) {
  const HumidAir air;
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 4u);
  for (const CloudCell& cell : columns.cells) {
    const double critical = criticalRelativeHumidity(cell.pressurePa, air.ground.pressurePa[0]);
    EXPECT_NEAR(cell.fraction, cloudFractionSundqvist(0.95, critical), 1e-4);
    EXPECT_GT(cell.liquidExtinctionPerMeter, 0.01);
    EXPECT_LT(cell.liquidExtinctionPerMeter, 0.06) << "as within stratocumulus";
  }
  EXPECT_TRUE(derives(columns, "cloud fraction", "derived from RH"));
  EXPECT_TRUE(derives(columns, "cloud water", "derived from RH"));
}

TEST(HumidityClouds, SpecificHumidityDoesAsWell) {
  HumidAir air;
  const CloudColumns relative = air.collected();
  for (Level& level : air.levels) {
    const float humidity = level.of(Quantity::RelativeHumidity)[0];
    const double saturation =
        saturationSpecificHumidity(level.pressurePa, level.of(Quantity::Temperature)[0]);
    level.values = {{Quantity::SpecificHumidity, {static_cast<float>(humidity * saturation)}},
                    {Quantity::Temperature, level.values[Quantity::Temperature]},
                    {Quantity::GeopotentialHeight, level.values[Quantity::GeopotentialHeight]}};
  }
  const CloudColumns specific = air.collected();
  ASSERT_EQ(specific.cells.size(), relative.cells.size());
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(specific.cells[i].liquidExtinctionPerMeter, relative.cells[i].liquidExtinctionPerMeter, 1e-5);
  EXPECT_TRUE(derives(specific, "relative humidity", "specific humidity"));
}

TEST(HumidityClouds, AreCutToTheModelsOwnCloudBaseAndTop) {
  HumidAir air;
  const CloudColumns whole = air.collected();
  const float base = whole.cells[0].topMeters - 50, top = whole.cells[3].baseMeters - 20;
  air.ground.cloudBaseMeters = {base};
  air.ground.cloudTopMeters = {top};
  const CloudColumns cut = air.collected();
  ASSERT_EQ(cut.cells.size(), 3u);
  EXPECT_FLOAT_EQ(cut.cells[0].baseMeters, base);
  EXPECT_FLOAT_EQ(cut.cells[2].topMeters, top);
  EXPECT_TRUE(derives(cut, "cloud base and top", "model's own"));
}

TEST(HumidityClouds, BaseAndTopThatSayNothingAreNotBelieved) {
  HumidAir air;
  for (const auto& [base, top] :
       {std::pair{kNan, kNan}, {-999.0f, -999.0f}, {3000.0f, 2000.0f}, {20.0f, kNan}}) {
    air.ground.cloudBaseMeters = {base};
    air.ground.cloudTopMeters = {top};
    EXPECT_EQ(air.collected().cells.size(), 4u) << base;
  }
}

TEST(HumidityClouds, NoneInTheStratosphere) {
  HumidAir air;
  air.levels.push_back(air.levels.back());
  air.levels.back().pressurePa = 5000;
  air.levels.back().values[Quantity::GeopotentialHeight] = {20000};
  air.levels.back().values[Quantity::RelativeHumidity] = {1};
  EXPECT_EQ(air.collected().cells.size(), 4u);
}

TEST(HumidityClouds, AGivenFractionComesFirst) {
  HumidAir air;
  for (Level& level : air.levels)
    level.values[Quantity::CloudFraction] = {level.pressurePa == 60000 ? 0.25f : 0};
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 1u);
  EXPECT_FLOAT_EQ(columns.cells[0].fraction, 0.25f);
  EXPECT_FALSE(derives(columns, "cloud fraction", "RH"));
  EXPECT_TRUE(derives(columns, "cloud water", "RH"));
}

TEST(HumidityClouds, NothingAboutCloudsIsAnError) {
  HumidAir air;
  air.erase(Quantity::RelativeHumidity);
  EXPECT_THROW(air.collected(), base::InputError);
}

}  // namespace
}  // namespace cloudgen::field
