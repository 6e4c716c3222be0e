// SPDX-License-Identifier: Apache-2.0
#include "field/collect.hpp"

#include <cmath>

#include "base/error.hpp"
#include "field/cloud_water.hpp"
#include "unit/field/made_levels.hpp"

namespace cloudgen::field {
namespace {

/// Two columns.
struct MadeSource : MadeLevels {
  MadeSource() : MadeLevels(2) {}
  /// A level of clear air; both columns alike.
  std::map<Quantity, std::vector<float>>& add(double hectopascals, float height, float temperature,
                                              float humidity = 0.5f) {
    levels.push_back({hectopascals * 100,
                      {{Quantity::GeopotentialHeight, {height, height}},
                       {Quantity::Temperature, {temperature, temperature}},
                       {Quantity::RelativeHumidity, {humidity, humidity}},
                       {Quantity::CloudLiquid, {0, 0}},
                       {Quantity::CloudIce, {0, 0}}}});
    return levels.back().values;
  }
};

/// Four levels, the third of which may get water: 0, 1000, 2000, 4000 m.
struct Atmosphere : MadeSource {
  Atmosphere() {
    add(1000, 0, 288);
    add(900, 1000, 282);
    add(800, 2000, 276, 0.9f);
    add(600, 4000, 262);
  }
  std::vector<float>& at(std::size_t level, Quantity quantity) { return levels[level].values[quantity]; }
};

TEST(Collect, SlabHasItsKnownOpticalDepth) {
  Atmosphere air;
  air.at(2, Quantity::CloudLiquid) = {2e-4f, 0};
  air.at(2, Quantity::CloudFraction) = {0.5f, 0.5f};
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 1u);
  EXPECT_EQ(columns.start, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_TRUE(columns.derived.empty());
  const CloudCell& cell = columns.cells[0];
  EXPECT_EQ(cell.level, 2u);
  EXPECT_NEAR(cell.baseMeters, 1500, 3);
  EXPECT_NEAR(cell.topMeters, 3000, 5);
  EXPECT_FLOAT_EQ(cell.fraction, 0.5f);
  const double density = airDensity(80000, 276, 0.9 * saturationSpecificHumidity(80000, 276));
  const double inCloudWater = 4e-4 * density;
  const double opticalDepth = cell.liquidExtinctionPerMeter * (cell.topMeters - cell.baseMeters);
  const double radius = std::cbrt(3 * inCloudWater / (4 * M_PI * 1000 * 0.77 * 1e8));
  EXPECT_NEAR(opticalDepth, 3 * inCloudWater * 1500 / (2 * 1000 * radius), 0.005 * opticalDepth);
  EXPECT_EQ(cell.iceExtinctionPerMeter, 0);
}

TEST(Collect, LowestAndHighestCellReachAsFarOutAsIn) {
  Atmosphere air;
  air.at(0, Quantity::CloudLiquid) = {1e-4f, 0};
  air.at(3, Quantity::CloudIce) = {1e-4f, 0};
  for (std::size_t level = 0; level < 4; ++level) air.at(level, Quantity::CloudFraction) = {1, 1};
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 2u);
  EXPECT_NEAR(columns.cells[0].baseMeters, -500, 2);
  EXPECT_NEAR(columns.cells[0].topMeters, 500, 2);
  EXPECT_NEAR(columns.cells[1].baseMeters, 3000, 5);
  EXPECT_NEAR(columns.cells[1].topMeters, 5000, 8);
}

TEST(Collect, NoCloudBelowTheGround) {
  Atmosphere air;
  for (std::size_t level = 0; level < 4; ++level) {
    air.at(level, Quantity::CloudLiquid) = {1e-4f, 1e-4f};
    air.at(level, Quantity::CloudFraction) = {1, 1};
  }
  air.ground.heightMeters = {1700, 0};
  CloudColumns columns = air.collected();
  ASSERT_EQ(columns.start, (std::vector<std::uint32_t>{0, 2, 6}));
  EXPECT_FLOAT_EQ(columns.cells[0].baseMeters, 1700);
  EXPECT_FLOAT_EQ(columns.states[0].surfaceHeightMeters, 1700);
  EXPECT_FLOAT_EQ(columns.cells[2].baseMeters, 0);

  air.ground = {{}, {85000, 101000}};
  columns = air.collected();
  EXPECT_EQ(columns.start, (std::vector<std::uint32_t>{0, 2, 6}));
}

TEST(Collect, TracesNegativeAndMissingWaterAreClear) {
  Atmosphere air;
  air.at(1, Quantity::CloudLiquid) = {9e-7f, -1e-4f};
  air.at(2, Quantity::CloudLiquid) = {kNan, std::numeric_limits<float>::infinity()};
  air.at(3, Quantity::CloudIce) = {-1e-3f, 1e-4f};
  air.at(3, Quantity::Temperature) = {262, kNan};
  EXPECT_TRUE(air.collected().cells.empty());
}

TEST(Collect, MissingHeightOfANeighbourIsComputedFromTheLevelBelow) {
  Atmosphere air;
  air.at(2, Quantity::CloudLiquid) = {1e-4f, 1e-4f};
  air.at(1, Quantity::GeopotentialHeight) = {kNan, 1000};
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 2u);
  const double computed = thickness(100000, 90000, 285 * 1.0003);
  EXPECT_NEAR(columns.cells[0].baseMeters, 0.5 * (computed + 2000), 3);
  EXPECT_NEAR(columns.cells[1].baseMeters, 1500, 3);
}

TEST(Collect, FractionIsRaisedUntilTheWaterFits) {
  Atmosphere air;
  air.at(2, Quantity::CloudLiquid) = {1.5e-3f, 6e-3f};
  air.at(2, Quantity::CloudFraction) = {0.1f, 0.1f};
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 2u);
  EXPECT_FLOAT_EQ(columns.cells[0].fraction, 0.5f);
  EXPECT_FLOAT_EQ(columns.cells[1].fraction, 1.0f);
}

TEST(Collect, FractionIsDerivedWhereNoneIsGivenOrAllIsZero) {
  for (const bool zeroes : {false, true}) {
    Atmosphere air;
    air.at(2, Quantity::CloudLiquid) = {1e-4f, 0};
    if (zeroes) air.at(2, Quantity::CloudFraction) = {0, 0};
    const CloudColumns columns = air.collected();
    ASSERT_EQ(columns.cells.size(), 1u);
    EXPECT_TRUE(derives(columns, "cloud fraction", "Xu & Randall"));
    EXPECT_EQ(derives(columns, "cloud fraction", "zero"), zeroes);
    EXPECT_NEAR(columns.cells[0].fraction,
                cloudFractionXuRandall(0.9, 1e-4, saturationSpecificHumidity(80000, 276)), 1e-5);
  }
}

TEST(Collect, CondensateIsSplitByTemperature) {
  Atmosphere air;
  for (std::size_t level = 0; level < 4; ++level) {
    auto& values = air.levels[level].values;
    values.erase(Quantity::CloudLiquid), values.erase(Quantity::CloudIce);
    values[Quantity::CloudCondensate] = {1e-4f, 0};
    values[Quantity::CloudFraction] = {1, 1};
  }
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 4u);
  EXPECT_TRUE(derives(columns, "liquid and ice", "split by temperature"));
  EXPECT_EQ(columns.cells[2].iceExtinctionPerMeter, 0) << "276 K";
  const double density = airDensity(60000, 262, 0.5 * saturationSpecificHumidity(60000, 262));
  EXPECT_NEAR(columns.cells[3].liquidExtinctionPerMeter, liquidExtinction(1e-4 * liquidShare(262) * density),
              1e-6);
  EXPECT_NEAR(columns.cells[3].iceExtinctionPerMeter,
              iceExtinction(1e-4 * (1 - liquidShare(262)) * density, 262), 1e-6);
}

/// Relative humidity over water for a dew point.
float humidityFor(double temperatureC, double dewPointC) {
  const auto vapour = [](double t) { return std::exp(17.502 * t / (240.97 + t)); };
  return static_cast<float>(vapour(dewPointC) / vapour(temperatureC));
}

TEST(Collect, KIndexByHand) {
  MadeSource air;
  air.add(1000, 100, 300);
  air.add(850, 1500, 293.15f, humidityFor(20, 15));
  air.add(700, 3000, 281.15f, humidityFor(8, 4));
  air.add(500, 5800, 263.15f);
  const CloudColumns columns = collectColumns(air, {0, 1});
  EXPECT_NEAR(columns.states[0].kIndexC, (20 + 10) + 15 - (8 - 4), 0.02);
  EXPECT_NEAR(columns.states[1].dewPoint700K, 277.15, 0.01);
  EXPECT_EQ(columns.states[0].surfaceHeightMeters, 0) << "nothing tells the ground: sea level";
}

TEST(Collect, KIndexIsMissingWhereItsLevelsAre) {
  EXPECT_TRUE(std::isnan(Atmosphere().collected().states[0].kIndexC));
}

TEST(Collect, SaysWhatIsMissing) {
  EXPECT_THROW(collectColumns(MadeSource(), {0}), base::InputError);
  Atmosphere air;
  for (const Quantity gone : {Quantity::CloudLiquid, Quantity::CloudIce, Quantity::RelativeHumidity})
    air.erase(gone);
  EXPECT_THROW(air.collected(), base::InputError);
}

TEST(Collect, WaterWithoutFractionAndHumidityIsOvercast) {
  Atmosphere air;
  air.at(2, Quantity::CloudLiquid) = {1e-4f, 0};
  air.erase(Quantity::RelativeHumidity);
  const CloudColumns columns = air.collected();
  ASSERT_EQ(columns.cells.size(), 1u);
  EXPECT_FLOAT_EQ(columns.cells[0].fraction, 1);
  EXPECT_TRUE(derives(columns, "cloud fraction", "neither"));
}

TEST(Collect, NoColumnsAreNoCells) {
  const Atmosphere air;
  for (const Level& level : air.levels) ASSERT_EQ(level.of(Quantity::Temperature).size(), 2u);
  EXPECT_EQ(collectColumns(air, {}).start, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace cloudgen::field
