// SPDX-License-Identifier: Apache-2.0
// One and the same air told in every way that models tell it.
#include "field/air.hpp"

#include <gtest/gtest.h>

#include "field/cloud_water.hpp"
#include "unit/field/made_levels.hpp"

namespace cloudgen::field {
namespace {

/// Heights and optics agree within 1 %.
void expectSame(const CloudColumns& told, const CloudColumns& made) {
  ASSERT_EQ(told.cells.size(), 4u);
  ASSERT_EQ(made.cells.size(), 4u);
  for (std::size_t i = 0; i < told.cells.size(); ++i) {
    const CloudCell &a = told.cells[i], &b = made.cells[i];
    EXPECT_NEAR(b.baseMeters, a.baseMeters, 0.01 * a.baseMeters);
    EXPECT_NEAR(b.topMeters, a.topMeters, 0.01 * a.topMeters);
    EXPECT_NEAR(b.topMeters - b.baseMeters, a.topMeters - a.baseMeters, 0.01 * (a.topMeters - a.baseMeters));
    EXPECT_NEAR(b.liquidExtinctionPerMeter, a.liquidExtinctionPerMeter, 0.01 * a.liquidExtinctionPerMeter);
    EXPECT_NEAR(b.temperatureK, a.temperatureK, 0.01 * a.temperatureK);
    EXPECT_NEAR(b.pressurePa, a.pressurePa, 0.01 * a.pressurePa);
  }
  EXPECT_NEAR(made.states[0].temperature700K, told.states[0].temperature700K, 1);
}

void heightsInstead(AnalyticAir& air, Quantity quantity, double minus) {
  for (Level& level : air.levels) {
    const double height = geometricHeight(level.of(Quantity::GeopotentialHeight)[0], 45);
    level.values[quantity] = {static_cast<float>(height - minus)};
    level.values.erase(Quantity::GeopotentialHeight);
    level.pressurePa = 0;
  }
}

TEST(Air, HeightsFromSurfacePressure) {
  for (const double lapse : {0.0065, 0.0, 0.0098}) {
    AnalyticAir air(lapse);
    const CloudColumns told = air.collected();
    air.erase(Quantity::GeopotentialHeight);
    const CloudColumns made = air.collected();
    expectSame(told, made);
    EXPECT_TRUE(derives(made, "height", "surface pressure"));
    EXPECT_FALSE(derives(told, "height", "hypsometric"));
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(made.cells[i].baseMeters, told.cells[i].baseMeters, 2) << "lapse rate " << lapse;
  }
}

TEST(Air, HeightsFromSeaLevelPressure) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  air.erase(Quantity::GeopotentialHeight);
  air.ground = {{500}, {}, {101000}};
  const CloudColumns made = air.collected();
  expectSame(told, made);
  EXPECT_TRUE(derives(made, "height", "sea-level pressure"));
}

TEST(Air, HeightsFromTheStandardAtmosphereAreStated) {
  AnalyticAir air;
  air.erase(Quantity::GeopotentialHeight);
  air.ground = {};
  const CloudColumns made = air.collected();
  ASSERT_EQ(made.cells.size(), 4u);
  EXPECT_TRUE(derives(made, "height", "ICAO"));
  EXPECT_EQ(made.states[0].surfaceHeightMeters, 0) << "isobaric levels do not follow the ground";
}

TEST(Air, PressureOfHybridLevelsIsAValueOfTheCell) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  air.erase(Quantity::GeopotentialHeight);
  for (Level& level : air.levels) {
    level.values[Quantity::Pressure] = {static_cast<float>(level.pressurePa)};
    level.pressurePa = 0;
  }
  expectSame(told, air.collected());
}

TEST(Air, LevelsOfHeightWithoutPressure) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  heightsInstead(air, Quantity::Height, 0);
  const CloudColumns made = air.collected();
  expectSame(told, made);
  EXPECT_TRUE(derives(made, "pressure", "hypsometric"));
  // The standard atmosphere knows nothing of the day's pressure, but only of the height.
  air.ground.pressurePa.clear();
  const CloudColumns unknown = air.collected();
  ASSERT_EQ(unknown.cells.size(), 4u);
  EXPECT_TRUE(derives(unknown, "pressure", "ICAO"));
  EXPECT_NEAR(unknown.cells[0].baseMeters, told.cells[0].baseMeters, 1);
}

TEST(Air, HeightsAboveGroundAreLiftedByTheOrography) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  heightsInstead(air, Quantity::HeightAboveGround, 500);
  const CloudColumns made = air.collected();
  expectSame(told, made);
  EXPECT_TRUE(derives(made, "height", "above ground"));
  air.ground = {};
  const CloudColumns flat = air.collected();
  ASSERT_EQ(flat.cells.size(), 4u);
  EXPECT_NEAR(flat.cells[0].baseMeters, told.cells[0].baseMeters - 500, 2);
  EXPECT_TRUE(derives(flat, "ground height", "sea level"));
}

TEST(Air, TemperatureFromThickness) {
  for (const double lapse : {0.0065, 0.0, 0.009}) {
    AnalyticAir air(lapse);
    const CloudColumns told = air.collected();
    air.erase(Quantity::Temperature);
    const CloudColumns made = air.collected();
    expectSame(told, made);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(made.cells[i].temperatureK, told.cells[i].temperatureK, 0.3);
    EXPECT_TRUE(derives(made, "temperature", "thickness"));
  }
}

TEST(Air, WithNothingButPressureItIsStandard) {
  AnalyticAir air;
  air.erase(Quantity::Temperature);
  air.erase(Quantity::GeopotentialHeight);
  air.ground = {};
  const CloudColumns made = air.collected();
  ASSERT_EQ(made.cells.size(), 4u);
  EXPECT_TRUE(derives(made, "temperature", "ICAO"));
  EXPECT_TRUE(derives(made, "height", "ICAO"));
  EXPECT_NEAR(made.cells[1].baseMeters, 0.5 * (1949 + 1691), 10) << "between 800 and 825 hPa";
}

TEST(Air, GroundFromSurfacePressureWhereThereIsNoOrography) {
  AnalyticAir air;
  air.ground.heightMeters.clear();
  const CloudColumns columns = air.collected();
  EXPECT_NEAR(columns.states[0].surfaceHeightMeters, 500, 3);
  EXPECT_TRUE(derives(columns, "ground height", "surface pressure"));
}

TEST(Air, ALoneLevelReaches50HectopascalsToEitherSide) {
  AnalyticAir air;
  for (const double wanted : {80000.0, 20000.0}) {
    AnalyticAir lone;
    std::erase_if(lone.levels, [&](const Level& level) { return level.pressurePa != wanted; });
    lone.levels[0].values[Quantity::CloudLiquid] = {3e-4f};
    lone.levels[0].values[Quantity::CloudFraction] = {0.6f};
    const CloudColumns columns = lone.collected();
    ASSERT_EQ(columns.cells.size(), 1u);
    EXPECT_NEAR(columns.cells[0].baseMeters, air.heightOf(wanted + 5000), 100);
    EXPECT_NEAR(columns.cells[0].topMeters, air.heightOf(wanted - 5000), 100);
    EXPECT_TRUE(derives(columns, "depth of a lone level", "50 hPa"));
  }
}

TEST(Air, WhatALevelLacksIsInterpolated) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  // Temperature on every second level only, humidity on every third, water not on one in the cloud.
  for (std::size_t i = 0; i < air.levels.size(); ++i) {
    if (i % 2) air.levels[i].values.erase(Quantity::Temperature);
    if (i % 3) air.levels[i].values.erase(Quantity::SpecificHumidity);
    if (air.levels[i].pressurePa == 80000) {
      air.levels[i].values.erase(Quantity::CloudLiquid);
      air.levels[i].values.erase(Quantity::CloudFraction);
    }
  }
  const CloudColumns made = air.collected();
  expectSame(told, made);
  EXPECT_TRUE(derives(made, "temperature", "interpolated"));
  EXPECT_TRUE(derives(made, "cloud liquid water", "interpolated"));
}

TEST(Air, HeightsThatSomeLevelsLackAreComputedFromThoseBelow) {
  AnalyticAir air;
  const CloudColumns told = air.collected();
  for (std::size_t i = 0; i < air.levels.size(); ++i)
    if (i % 4) air.levels[i].values.erase(Quantity::GeopotentialHeight);
  expectSame(told, air.collected());
}

TEST(Air, AbsurdValuesDoNotPassAsAir) {
  AnalyticAir air;
  air.erase(Quantity::GeopotentialHeight);
  air.ground.pressurePa = {-1};
  air.ground.heightMeters = {1e30f};
  air.levels[3].values[Quantity::Temperature] = {kNan};
  air.levels[5].values[Quantity::Temperature] = {1e20f};
  air.levels[6].values[Quantity::SpecificHumidity] = {-std::numeric_limits<float>::infinity()};
  for (const CloudCell& cell : air.collected().cells) {
    EXPECT_TRUE(std::isfinite(cell.baseMeters) && std::isfinite(cell.topMeters));
    EXPECT_LT(cell.baseMeters, cell.topMeters);
  }
}

}  // namespace
}  // namespace cloudgen::field
