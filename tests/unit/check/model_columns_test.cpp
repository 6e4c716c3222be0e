// SPDX-License-Identifier: Apache-2.0
// What the model says of a column: layers, overlap, heights.
#include "check/fidelity/model_columns.hpp"

#include <gtest/gtest.h>

#include "field/collect.hpp"
#include "made_model.hpp"

namespace cloudgen::check::test {
namespace {

/// One column with cloud water on levels 50 hPa apart, from 1000 hPa upwards.
class LevelModel : public MadeModel {
 public:
  explicit LevelModel(std::vector<float> covers) : covers_(std::move(covers)) {}
  field::Telling telling() const override { return field::Telling::Levels; }
  void visitLevels(std::span<const std::uint32_t> cells,
                   const std::function<void(const field::Level&)>& visit) const override {
    for (std::size_t i = 0; i < covers_.size(); ++i) {
      field::Level level;
      level.pressurePa = 100000 - 5000.0 * static_cast<double>(i);
      const auto put = [&](field::Quantity quantity, float value) {
        level.values[quantity].assign(cells.size(), value);
      };
      put(field::Quantity::Temperature, 285 - 3.0f * static_cast<float>(i));
      put(field::Quantity::RelativeHumidity, 0.9f);
      put(field::Quantity::CloudFraction, covers_[i]);
      put(field::Quantity::CloudLiquid, covers_[i] * 2e-4f);
      visit(level);
    }
  }

 private:
  std::vector<float> covers_;
};

ModelColumn columnOf(const field::Source& model) {
  const auto columns = modelColumns(model, {10.0, 50.0, 10.5, 50.5});
  EXPECT_EQ(columns.size(), 1u);
  return columns.front();
}

TEST(ModelColumns, LevelsOverlapWithinALayerAndLayersByChance) {
  const LevelModel model({0, 0.3f, 0.6f, 0, 0.5f, 0, 0});
  const ModelColumn column = columnOf(model);
  EXPECT_NEAR(column.view.cover, 1 - (1 - 0.6) * (1 - 0.5), 1e-6);
  EXPECT_NEAR(
      column.view.coverIn[0] + column.view.coverIn[1] - column.view.coverIn[0] * column.view.coverIn[1],
      column.view.cover, 1e-6);
  double depth = 0;
  const auto cells = field::collectColumns(model, {0});
  for (const field::CloudCell& cell : cells.cells)
    depth += static_cast<double>(cell.fraction) *
             (cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter) *
             (cell.topMeters - cell.baseMeters);
  EXPECT_NEAR(column.view.opticalDepth, depth, 1e-3 * depth);
  EXPECT_GT(column.view.baseMeters.value(), cells.cells.front().baseMeters);
  EXPECT_LT(column.view.baseMeters.value(), cells.cells.front().topMeters);
  EXPECT_GT(column.view.topMeters.value(), cells.cells.back().baseMeters);
  EXPECT_LT(column.view.topMeters.value(), cells.cells.back().topMeters);
  EXPECT_NEAR(column.levelMeters, 430, 60);
}

TEST(ModelColumns, ClearIsClear) {
  const ModelColumn column = columnOf(LevelModel({0, 0, 0}));
  EXPECT_EQ(column.view.cover, 0);
  EXPECT_EQ(column.view.opticalDepth, 0);
  EXPECT_FALSE(column.view.baseMeters.has_value());
}

TEST(ModelColumns, RangesArePartedInClearAir) {
  MadeModel model;
  const auto state = [&](float base, float top, float cover, float depth) {
    model.layers.push_back(
        {.cell = 0, .coverFraction = cover, .baseMeters = base, .topMeters = top, .opticalDepth = depth});
  };
  state(800, 5000, 0.4f, 20);
  state(7000, 9000, 0.5f, 1);
  state(10000, 11000, 0.9f, 0.05f);
  const ModelColumn column = columnOf(model);
  EXPECT_NEAR(column.view.coverIn[0], 0.4, 1e-6);
  EXPECT_EQ(column.view.coverIn[1], 0);
  EXPECT_NEAR(column.view.coverIn[2], 0.5, 1e-6) << "what is too thin to see is no cover";
  EXPECT_NEAR(column.view.opticalDepth, 0.4 * 20 + 0.5 * 1 + 0.9 * 0.05, 1e-5);
  EXPECT_NEAR(column.borders[0], 6000, 1e-6);
  EXPECT_NEAR(column.borders[1], 6000, 1e-6);
  EXPECT_NEAR(column.view.topMeters.value(), 8900, 1);
  EXPECT_NEAR(column.view.baseMeters.value(), 1010, 1);
}

TEST(ModelColumns, TouchingLayersOverlapMoreThanByChance) {
  MadeModel model;
  const auto state = [&](float base, float top, float cover) {
    model.layers.push_back(
        {.cell = 0, .coverFraction = cover, .baseMeters = base, .topMeters = top, .opticalDepth = 10});
  };
  state(800, 1200, 0.4f);
  state(1200, 1600, 0.5f);
  const double together = columnOf(model).view.cover;
  EXPECT_GT(together, 0.5 + 0.01);
  EXPECT_LT(together, 1 - 0.6 * 0.5 - 0.1);
  state(8000, 9000, 0.3f);
  EXPECT_NEAR(columnOf(model).view.cover, 1 - (1 - together) * 0.7, 1e-6);
}

TEST(ModelColumns, ABoxCutsAColumn) {
  const auto columns = modelColumns(MadeModel(), {10.25, 50.0, 11.0, 50.5});
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_NEAR(columns[0].shareInside, 0.5, 0.01);
  EXPECT_NEAR(columns[1].squareMeters / columns[0].squareMeters, 2, 0.02);
}

}  // namespace
}  // namespace cloudgen::check::test
