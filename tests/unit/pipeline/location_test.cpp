// SPDX-License-Identifier: Apache-2.0
#include "pipeline/location.hpp"

#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

field::CloudCell part(std::uint32_t level, float fraction, float liquid, float ice = 0) {
  field::CloudCell cell;
  cell.level = level;
  cell.baseMeters = 500.0f * static_cast<float>(level);
  cell.topMeters = cell.baseMeters + 500;
  cell.fraction = fraction;
  cell.liquidExtinctionPerMeter = liquid;
  cell.iceExtinctionPerMeter = ice;
  cell.temperatureK = 290 - 3 * static_cast<float>(level);
  cell.windEast = static_cast<float>(level);
  cell.windNorth = 4;
  cell.pressurePa = 1e5f - 5e3f * static_cast<float>(level);
  return cell;
}

std::vector<field::Layer> layersOf(const std::vector<field::CloudCell>& cells) {
  field::CloudColumns columns;
  columns.columns = {17};
  columns.states.resize(1);
  columns.states[0].surfaceHeightMeters = 120;
  columns.states[0].kIndexC = 25;
  columns.start = {0, static_cast<std::uint32_t>(cells.size())};
  columns.cells = cells;
  return locateLayers(columns);
}

TEST(Location, ASlabHasItsKnownBaseTopCoverAndDepth) {
  const auto layers = layersOf({part(2, 0.5f, 0.02f), part(3, 0.25f, 0.04f, 0.01f), part(4, 0.5f, 0, 0.02f)});
  ASSERT_EQ(layers.size(), 1u);
  const field::Layer& layer = layers[0];
  EXPECT_EQ(layer.cell, 17u);
  EXPECT_EQ(layer.baseMeters, 1000);
  EXPECT_EQ(layer.topMeters, 2500);
  EXPECT_EQ(layer.surfaceMeters, 120);
  EXPECT_EQ(layer.kIndexC, 25);
  EXPECT_FLOAT_EQ(layer.fraction, 0.5f);
  // Grid-mean optical depth 0.5*0.02*500 + 0.25*0.04*500 = 10 of liquid, 0.25*0.01*500 + 0.5*0.02*500 = 6.25
  // of ice.
  EXPECT_NEAR(layer.liquidOpticalDepth, 10 / 0.5, 1e-4);
  EXPECT_NEAR(layer.iceOpticalDepth, 6.25 / 0.5, 1e-4);
  EXPECT_FLOAT_EQ(layer.baseTemperatureK, 284);
  EXPECT_FLOAT_EQ(layer.topTemperatureK, 278);
  EXPECT_FLOAT_EQ(layer.windEast, 3);
  EXPECT_FLOAT_EQ(layer.windNorth, 4);
  EXPECT_FLOAT_EQ(layer.shearEast, 2);
  EXPECT_FLOAT_EQ(layer.shearNorth, 0);
  EXPECT_TRUE(layer.rule.empty());
}

TEST(Location, HalfOfALayersWaterLiesBelowItsMiddle) {
  EXPECT_FLOAT_EQ(layersOf({part(2, 0.5f, 0.02f), part(3, 0.5f, 0.02f)}).front().middleMeters, 1500);
  EXPECT_FLOAT_EQ(layersOf({part(2, 0.5f, 0.06f), part(3, 0.5f, 0.02f)}).front().middleMeters,
                  1000 + 500 * 2 / 3.0f);
}

TEST(Location, AClearLevelParts) {
  const auto layers = layersOf({part(1, 0.3f, 0.02f), part(2, 0.3f, 0.02f), part(5, 0.8f, 0.01f)});
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].topMeters, 1500);
  EXPECT_EQ(layers[1].baseMeters, 2500);
  EXPECT_EQ(layers[0].ordinal, 0);
  EXPECT_EQ(layers[1].ordinal, 1);
}

TEST(Location, AWaistParts) {
  const auto waist = layersOf({part(1, 1, 0.02f), part(2, 1, 0.001f), part(3, 1, 0.03f), part(4, 1, 0.03f)});
  ASSERT_EQ(waist.size(), 2u);
  EXPECT_EQ(waist[0].topMeters, waist[1].baseMeters);
  EXPECT_EQ(layersOf({part(1, 1, 0.02f), part(2, 1, 0.005f), part(3, 1, 0.03f)}).size(), 1u);
  EXPECT_EQ(layersOf({part(1, 1, 0.02f), part(2, 1, 0.001f), part(3, 1, 0.0005f)}).size(), 1u);
}

TEST(Location, WhatNobodySeesIsNoLayer) {
  EXPECT_TRUE(layersOf({part(20, 0.5f, 0, 5e-5f)}).empty());
  EXPECT_TRUE(layersOf({}).empty());
}

TEST(Location, StatedLayersAreTakenAsTheyAre) {
  const field::StatedLayer low{4, base::Genus::Cumulus, 0.3f, 900, 1500, 12, 0, 0, 0, 0, 5, 6, 1, 2};
  const field::StatedLayer high{4, base::Genus::Cirrus, 0.6f, 9000, 9800, 0.4f, 1, 0, 0, 0, 30};
  test::MadeSource source(10, 45, 1, 3, 3);
  source.layers = {low, high};
  const std::vector<std::uint32_t> cells{3, 4, 5};
  const auto layers = locateLayers(source, cells);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].genus, base::Genus::Cumulus);
  EXPECT_EQ(layers[0].rule, "stated");
  EXPECT_EQ(layers[1].ordinal, 1);
  EXPECT_FLOAT_EQ(layers[0].opticalDepth(), 12);
  EXPECT_FLOAT_EQ(layers[1].windEast, 30);
  EXPECT_FLOAT_EQ(layers[0].shearNorth, 2);
}

field::Layer layerAt(std::uint32_t cell, float base, float top) {
  field::Layer layer;
  layer.cell = cell;
  layer.baseMeters = base;
  layer.topMeters = top;
  return layer;
}

TEST(Patches, NeighboursThatOverlapBelongTogether) {
  field::Grid grid;
  grid.columns = 4, grid.rows = 3, grid.stepX = grid.stepY = 1, grid.firstX = 10, grid.firstY = 45;
  std::vector layers{layerAt(0, 1000, 2000), layerAt(1, 1400, 1800),  // side by side
                     layerAt(6, 1500, 2200),                          // cornerwise to cell 1
                     layerAt(0, 8000, 9000),                          // above
                     layerAt(3, 1000, 2000),                          // cornerwise to cell 6
                     layerAt(8, 1000, 2000)};                         // apart
  EXPECT_EQ(joinPatches(grid, layers), 3u);
  EXPECT_EQ(layers[0].patch, layers[1].patch);
  EXPECT_EQ(layers[0].patch, layers[2].patch);
  EXPECT_EQ(layers[0].patch, layers[4].patch);
  EXPECT_NE(layers[0].patch, layers[3].patch);
  EXPECT_NE(layers[0].patch, layers[5].patch);
  for (const field::Layer& layer : layers) EXPECT_LT(layer.patch, 3u);
}

TEST(Patches, ASlightOverlapIsNotEnough) {
  field::Grid grid;
  grid.columns = 2, grid.rows = 1, grid.stepX = grid.stepY = 1;
  std::vector layers{layerAt(0, 1000, 2000), layerAt(1, 1700, 3000)};
  EXPECT_EQ(joinPatches(grid, layers), 2u);
}

TEST(Patches, JoinAcrossTheAntimeridianOfAGlobalGrid) {
  field::Grid grid;
  grid.columns = 8, grid.rows = 1, grid.stepX = 45, grid.stepY = 1, grid.wrapsLongitude = true;
  std::vector layers{layerAt(0, 1000, 2000), layerAt(7, 1000, 2000)};
  EXPECT_EQ(joinPatches(grid, layers), 1u);
  grid.wrapsLongitude = false;
  EXPECT_EQ(joinPatches(grid, layers), 2u);
}

}  // namespace
}  // namespace cloudgen::pipeline
