// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pairing.hpp"

#include <set>

#include "pipeline/pipeline.hpp"
#include "support/made_source.hpp"

namespace cloudgen::pipeline {
namespace {

using base::Genus;
using field::Layer;

field::Grid gridOf(double stepDegrees, int cells) {
  field::Grid grid;
  grid.columns = grid.rows = cells;
  grid.stepX = grid.stepY = stepDegrees;
  grid.firstX = 10 + 0.5 * stepDegrees, grid.firstY = 40 + 0.5 * stepDegrees;
  return grid;
}

const field::Grid kCoarse = gridOf(1, 2), kFine = gridOf(0.25, 8);

Layer layerAt(std::uint32_t cell, float base, float top, float cover) {
  Layer layer;
  layer.cell = cell;
  layer.baseMeters = base;
  layer.topMeters = top;
  layer.fraction = cover;
  layer.liquidOpticalDepth = 12;
  return layer;
}

Layer typed(std::uint32_t cell, Genus genus, float base, float top, float cover) {
  Layer layer = layerAt(cell, base, top, cover);
  layer.genus = genus;
  layer.rule = "stated";
  layer.liquidOpticalDepth = 5;
  return layer;
}

std::vector<std::uint32_t> allOf(const field::Grid& grid) {
  return field::cellsTouching(grid, field::extent(grid));
}

double coverOf(const std::vector<Layer>& layers, const field::Grid& grid) {
  double sum = 0;
  for (const Layer& layer : layers) sum += layer.fraction * field::cellAreaSquareMeters(grid, layer.cell);
  return sum;
}

/// The fine cells of coarse cell 0.
std::vector<std::uint32_t> childrenOfFirst() {
  std::vector<std::uint32_t> cells;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) cells.push_back(kFine.index(column, row));
  return cells;
}

TEST(Pairing, TheFinerGridIsTakenWhereItIsAllThere) {
  const base::GeoBox box{10, 40, 12, 42};
  EXPECT_TRUE(overlayOf(kCoarse, kFine, box).standOnTyping());
  EXPECT_FALSE(overlayOf(kFine, kCoarse, box).standOnTyping());
  field::Grid half = kFine;
  half.columns = 4;
  EXPECT_DOUBLE_EQ(overlayOf(kCoarse, half, box).typedShare, 0.5);
  EXPECT_FALSE(overlayOf(kCoarse, half, box).standOnTyping());
}

/// A model of water all over, and a typing that says stratocumulus wherever it is.
Outcome runWithTyping(test::MadeSource& model, test::MadeSource& typing) {
  field::StatedLayer water = test::cumulusLayer();
  water.genus.reset();
  model.cover(water);
  typing.cover(test::stratocumulusLayer());
  Options options = test::usualOptions(20'000);
  options.typing = &typing;
  return run(model, options, {});
}

TEST(Pairing, CloudsOfTheModelStayWhereTheTypingHasNothing) {
  test::MadeSource model(10, 40, 1, 4, 4), typing(10, 40, 0.25, 8, 16);
  const Outcome outcome = runWithTyping(model, typing);
  EXPECT_EQ(outcome.layers, 16u);
  EXPECT_EQ(outcome.pairing->modelAlone, 8u);
  EXPECT_TRUE(std::any_of(outcome.warnings.begin(), outcome.warnings.end(), [](const std::string& warning) {
    return warning.find("covers 50 % of the box") != std::string::npos;
  }));
}

TEST(Pairing, AFinerTypingSharesTheModelsCoverAndKeepsIt) {
  const std::vector<Layer> water{layerAt(0, 900, 2200, 0.3f)};
  std::vector<Layer> typing;
  for (const std::uint32_t cell : childrenOfFirst())
    if (cell % 2 == 0) typing.push_back(typed(cell, Genus::Cumulus, 1000, 2500, 0.9f));
  const PairedLayers paired = pairLayers(kCoarse, water, kFine, typing, true, allOf(kFine));
  EXPECT_EQ(paired.layers.size(), 8u);
  EXPECT_NEAR(coverOf(paired.layers, kFine) / coverOf(water, kCoarse), 1, 1e-3);
  for (const Layer& layer : paired.layers) {
    EXPECT_EQ(layer.genus, Genus::Cumulus);
    EXPECT_EQ(layer.rule, "typing");
    EXPECT_FLOAT_EQ(layer.opticalDepth(), 12) << "the model decides the density";
    EXPECT_FLOAT_EQ(layer.topMeters, 2500) << "the finer typing decides the heights";
  }
  EXPECT_EQ(paired.pairing.typedColumns, 8u);
  EXPECT_EQ(paired.pairing.agreeingColumns, 8u);
  EXPECT_NEAR(paired.pairing.keptCover / paired.pairing.modelCover, 1, 1e-3);
}

TEST(Pairing, CoverThatTypedCellsCannotHoldSpreadsToClearOnes) {
  const std::vector<Layer> water{layerAt(0, 900, 2200, 0.8f)};
  const std::vector<Layer> typing{typed(0, Genus::Stratocumulus, 1000, 1800, 0.5f)};
  const PairedLayers paired = pairLayers(kCoarse, water, kFine, typing, true, allOf(kFine));
  EXPECT_EQ(paired.layers.size(), 16u);
  EXPECT_NEAR(coverOf(paired.layers, kFine) / coverOf(water, kCoarse), 1, 1e-3);
  for (const Layer& layer : paired.layers) {
    EXPECT_EQ(layer.genus, Genus::Stratocumulus);
    EXPECT_EQ(layer.rule, layer.cell == 0 ? "typing" : "typing.spread");
  }
}

TEST(Pairing, TypingWhereTheModelIsClearKeepsItsOwnAmount) {
  const std::vector<Layer> water{layerAt(0, 900, 2200, 0.3f)};
  const std::vector<Layer> typing{typed(0, Genus::Cirrus, 9000, 10000, 0.6f)};
  const PairedLayers paired = pairLayers(kCoarse, water, kFine, typing, true, allOf(kFine));
  std::set<std::string_view> inTyped;
  for (const Layer& layer : paired.layers)
    if (layer.cell == 0) inTyped.insert(layer.rule);
  EXPECT_EQ(inTyped, std::set<std::string_view>{"typing.alone"})
      << "the model's own cloud goes to untyped cells";
  EXPECT_EQ(paired.pairing.typingAlone, 1u);
  EXPECT_EQ(paired.pairing.modelAlone, 1u);
  EXPECT_EQ(paired.pairing.agreeingColumns, 1u);
  EXPECT_NEAR(paired.pairing.keptCover / paired.pairing.modelCover, 1, 1e-3);
}

TEST(Pairing, AFinerModelKeepsItsAmountAndTakesTheGenus) {
  std::vector<Layer> water;
  for (const std::uint32_t cell : childrenOfFirst())
    if (cell % 3 == 0) water.push_back(layerAt(cell, 900, 2200, 0.7f));
  const std::vector<Layer> typing{typed(0, Genus::Stratocumulus, 1000, 1800, 0.5f),
                                  typed(0, Genus::Cirrus, 9000, 10000, 0.4f)};
  const PairedLayers paired = pairLayers(kFine, water, kCoarse, typing, false, allOf(kFine));
  std::size_t low = 0, high = 0;
  for (const Layer& layer : paired.layers) {
    EXPECT_FLOAT_EQ(layer.fraction, layer.genus == Genus::Cirrus ? 0.4f : 0.7f);
    ++(layer.genus == Genus::Cirrus ? high : low);
  }
  EXPECT_EQ(low, water.size());
  EXPECT_EQ(high, 16u) << "the model has no cirrus: the typing's, all over its cell";
  EXPECT_EQ(paired.pairing.typedColumns, 1u);
  EXPECT_EQ(paired.pairing.agreeingColumns, 1u);
}

TEST(Pairing, AnUnknownTypeIsLeftToTheRules) {
  std::vector<Layer> typing{typed(0, Genus::Cumulus, 1000, 1800, 0.5f)};
  typing[0].rule = {};
  const PairedLayers paired =
      pairLayers(kCoarse, {layerAt(0, 900, 2200, 0.01f)}, kFine, typing, true, allOf(kFine));
  for (const Layer& layer : paired.layers) EXPECT_TRUE(layer.rule.empty());
  EXPECT_EQ(paired.pairing.typedColumns, 0u);
}

TEST(Pairing, ABoxGivesTheSameLayersAsTheWhole) {
  const field::Grid model = gridOf(1, 6), typing = gridOf(0.25, 24);
  const auto layersIn = [&](const std::vector<std::uint32_t>& modelCells,
                            const std::vector<std::uint32_t>& typingCells) {
    std::vector<Layer> water, types;
    for (const std::uint32_t cell : modelCells)
      water.push_back(layerAt(cell, 900, 2000, 0.1f + 0.02f * static_cast<float>(cell)));
    for (const std::uint32_t cell : typingCells)
      if (cell % 3 == 0)
        types.push_back(typed(cell, cell % 2 ? Genus::Cumulus : Genus::Stratocumulus, 1000, 1900, 0.5f));
    return pairLayers(model, water, typing, types, true, typingCells).layers;
  };
  const base::GeoBox box{12.3, 42.3, 13.6, 43.6};
  const base::GeoBox grown = grownBox(model, typing, box), around = grownBox(model, typing, grown);
  const auto shown = field::cellsTouching(typing, box);
  const auto inBox = [&](const std::vector<Layer>& layers) {
    std::vector<std::tuple<std::uint32_t, int, float>> found;
    for (const Layer& layer : layers)
      if (std::binary_search(shown.begin(), shown.end(), layer.cell))
        found.emplace_back(layer.cell, layer.ordinal, layer.fraction);
    return found;
  };
  const auto whole = inBox(layersIn(allOf(model), allOf(typing)));
  EXPECT_EQ(inBox(layersIn(field::cellsTouching(model, around), field::cellsTouching(typing, grown))), whole);
  EXPECT_GE(whole.size(), shown.size() / 3);
}

TEST(Pairing, ARunWithATypingReportsIt) {
  test::MadeSource model(10, 40, 1, 2, 2), typing(10, 40, 0.25, 8, 8);
  const Outcome outcome = runWithTyping(model, typing);
  ASSERT_TRUE(outcome.pairing);
  EXPECT_EQ(outcome.pairing->agreeingColumns, 64u);
  ASSERT_FALSE(outcome.scene.clouds.empty());
  for (const auto& cloud : outcome.scene.clouds) EXPECT_EQ(cloud.genus, Genus::Stratocumulus);
}

}  // namespace
}  // namespace cloudgen::pipeline
