// SPDX-License-Identifier: Apache-2.0
#include "pipeline/type.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace cloudgen::pipeline {
namespace {

using base::Genus;

/// A sky of one layer over one cell of a degree (8 600 km2) at 45 N, where the high etage begins at 5 km.
struct Case {
  std::string rule;
  Genus genus;
  float base, top, fraction, liquid, ice, topKelvin = 270, kIndex = 0;
};

const Case kCases[] = {
    {"cirrus.veil", Genus::Cirrostratus, 8000, 9000, 0.9f, 0, 2},
    {"cirrus.grains", Genus::Cirrocumulus, 8000, 8400, 0.5f, 0, 0.8f},
    {"cirrus.signature", Genus::Cirrus, 8000, 9500, 0.3f, 0, 1},
    {"cirrus.thick", Genus::Cirrostratus, 7000, 9500, 0.9f, 0, 6},
    {"cumulonimbus.signature", Genus::Cumulonimbus, 800, 11000, 0.4f, 60, 20, 220, 30},
    {"fog.signature", Genus::Fog, 20, 250, 0.9f, 5, 0},
    {"rain.deep", Genus::Nimbostratus, 900, 4500, 0.95f, 40, 0},
    {"low.cumuliform", Genus::Cumulus, 1200, 2500, 0.2f, 20, 0},
    {"low.deep_cumuliform", Genus::Cumulonimbus, 1000, 7000, 0.2f, 15, 5, 245, 10},
    {"low.uniform", Genus::Stratus, 300, 700, 0.9f, 8, 0},
    {"low.rolls", Genus::Stratocumulus, 1000, 1600, 0.8f, 10, 0},
    {"middle.elements", Genus::Altocumulus, 3500, 4200, 0.8f, 4, 1},
    {"middle.veil", Genus::Altostratus, 3600, 6000, 0.9f, 6, 6},
    {"middle.rain", Genus::Nimbostratus, 2500, 6000, 0.9f, 30, 10},
    {"middle.tower", Genus::Cumulonimbus, 3200, 9000, 0.4f, 30, 10, 230, 25},
    {"high.default", Genus::Cirrus, 6000, 6500, 0.5f, 3, 1},
};

field::Grid oneCell() {
  field::Grid grid;
  grid.columns = grid.rows = 1, grid.stepX = grid.stepY = 1, grid.firstX = 10, grid.firstY = 45;
  return grid;
}

field::Layer typed(const Case& sky) {
  field::Layer layer;
  layer.baseMeters = sky.base;
  layer.topMeters = sky.top;
  layer.fraction = sky.fraction;
  layer.liquidOpticalDepth = sky.liquid;
  layer.iceOpticalDepth = sky.ice;
  layer.topTemperatureK = sky.topKelvin;
  layer.kIndexC = sky.kIndex;
  std::vector layers{layer};
  typeLayers(oneCell(), layers);
  return layers[0];
}

TEST(Type, EachRuleHasItsSky) {
  for (const Case& sky : kCases) {
    const field::Layer layer = typed(sky);
    EXPECT_EQ(layer.rule, sky.rule);
    EXPECT_EQ(layer.genus, sky.genus) << sky.rule;
  }
}

TEST(Type, EveryRuleIsReachedAndExplained) {
  std::set<std::string_view> reached{"stated", "typing", "typing.alone", "typing.spread"}, explained;
  for (const Case& sky : kCases) reached.insert(typed(sky).rule);
  for (const TypeRule& rule : typeRules()) {
    EXPECT_TRUE(explained.insert(rule.id).second) << rule.id << " stands twice";
    EXPECT_FALSE(rule.meaning.empty());
  }
  EXPECT_EQ(reached, explained);
}

TEST(Type, WhatTheSourceStatesStays) {
  field::Layer layer;
  layer.baseMeters = 9000, layer.topMeters = 9500, layer.fraction = 1, layer.iceOpticalDepth = 1;
  layer.genus = Genus::Altostratus;
  layer.rule = "stated";
  std::vector layers{layer};
  typeLayers(oneCell(), layers);
  EXPECT_EQ(layers[0].genus, Genus::Altostratus);
  EXPECT_EQ(layers[0].rule, "stated");
}

TEST(Type, FogKeepsToTheGroundAlsoInTheMountains) {
  field::Layer layer;
  layer.surfaceMeters = 1800, layer.baseMeters = 1810, layer.topMeters = 2000, layer.fraction = 0.9f;
  layer.liquidOpticalDepth = 4, layer.topTemperatureK = 275;
  std::vector layers{layer};
  typeLayers(oneCell(), layers);
  EXPECT_EQ(layers[0].genus, Genus::Fog);
}

TEST(Type, AMissingKIndexIsStableAir) {
  Case tower = kCases[4];
  tower.fraction = 0.9f;
  tower.kIndex = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(typed(tower).genus, Genus::Nimbostratus);
}

TEST(Type, ASmallPatchIsHeapedAndALargeOneALayer) {
  field::Grid grid = oneCell();
  grid.stepX = grid.stepY = 0.1;
  grid.columns = grid.rows = 3;
  field::Layer layer;
  layer.baseMeters = 1000, layer.topMeters = 1600, layer.fraction = 0.8f, layer.liquidOpticalDepth = 10;
  std::vector small{layer}, large(9, layer);
  typeLayers(grid, small);
  EXPECT_EQ(small[0].genus, Genus::Cumulus);
  for (std::uint32_t i = 0; i < 9; ++i) large[i].cell = i;
  typeLayers(grid, large);
  EXPECT_EQ(large[4].genus, Genus::Stratocumulus);
}

/// Five by five cells of a tenth of a degree with the same layer over each.
std::pair<field::Grid, std::vector<field::Layer>> sheet(float fraction) {
  field::Grid grid = oneCell();
  grid.stepX = grid.stepY = 0.1;
  grid.columns = grid.rows = 5;
  std::vector<field::Layer> layers(25);
  for (std::uint32_t i = 0; i < 25; ++i) {
    layers[i].cell = i;
    layers[i].baseMeters = 1000, layers[i].topMeters = 1600;
    layers[i].fraction = fraction, layers[i].liquidOpticalDepth = 10;
  }
  return {grid, layers};
}

TEST(Type, BrokennessIsThatOfTheField) {
  auto [grid, layers] = sheet(0.9f);
  layers[12].fraction = 0.25f;  // a thin spot in a sheet
  const auto surroundings = typeLayers(grid, layers);
  EXPECT_EQ(layers[12].genus, Genus::Stratocumulus);
  EXPECT_GT(surroundings[12].coverAround, 0.6f);
  EXPECT_LT(surroundings[12].coverAround, 0.9f);
  EXPECT_NEAR(surroundings[0].patchSquareKilometers, 0.9 * 25 * 87, 150);
}

TEST(Type, LayersAtOtherHeightsAreNoNeighbours) {
  auto [grid, layers] = sheet(0.9f);
  layers[12].fraction = 0.25f;
  layers[12].baseMeters = 1700, layers[12].topMeters = 1900;
  const auto surroundings = typeLayers(grid, layers);
  EXPECT_FLOAT_EQ(surroundings[12].coverAround, 0.25f);
  EXPECT_EQ(layers[12].genus, Genus::Cumulus);
  EXPECT_FLOAT_EQ(surroundings[0].coverAround, 0.9f);
}

TEST(Type, UnknownValuesStayOutOfMeans) {
  auto [grid, layers] = sheet(0.9f);
  layers[13].kIndexC = 30;
  const auto surroundings = typeLayers(grid, layers);
  EXPECT_FLOAT_EQ(surroundings[12].kIndexAroundC, 30);
  EXPECT_TRUE(std::isnan(surroundings[15].kIndexAroundC));
}

TEST(Type, ARuleSaysWhatItDecidesBy) {
  const auto rules = typeRules();
  const auto storm = std::find_if(rules.begin(), rules.end(),
                                  [](auto& rule) { return rule.id == "cumulonimbus.signature"; });
  ASSERT_NE(storm, rules.end());
  EXPECT_EQ(storm->meaning,
            "base above ground under 3000 m, depth over 5000 m, top temperature under -25 C, optical depth "
            "over 23, K-index here and around over 20 C: cumulonimbus");
}

TEST(Type, TheFirstRuleThatHoldsDecidesAndTheLastTakesTheRest) {
  Traits traits;
  traits.values.fill(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(decidingRule(traits).id, derivingRules().back().id);
  traits[Trait::BaseAboveGround] = 20, traits[Trait::TopAboveGround] = 200;
  EXPECT_EQ(decidingRule(traits).id, "fog.signature");
  for (const Rule& rule : derivingRules()) EXPECT_EQ(holds(rule, traits), rule.id == "fog.signature");
}

}  // namespace
}  // namespace cloudgen::pipeline
