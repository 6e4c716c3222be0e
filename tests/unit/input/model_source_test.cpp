// SPDX-License-Identifier: Apache-2.0
#include "input/model/model_source.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "support/made_contents.hpp"

namespace cloudgen::input::model {
namespace {

using field::Quantity;
using test::MadeContents;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

std::vector<field::Level> levelsOf(const field::Source& source) {
  std::vector<field::Level> levels;
  source.visitLevels(field::everyCell(source.grid()),
                     [&](const field::Level& level) { levels.push_back(level); });
  return levels;
}

std::vector<field::StatedLayer> layersOf(const field::Source& source) {
  std::vector<field::StatedLayer> layers;
  source.visitLayers(std::vector<std::uint32_t>{5}, [&](const auto& layer) { layers.push_back(layer); });
  return layers;
}

std::vector<std::string> warningIds(const field::Source& source) {
  std::vector<std::string> ids;
  for (const field::Warning& warning : source.info().warnings) ids.push_back(warning.id);
  return ids;
}

/// Water, temperature and height on three pressure levels, in no order.
MadeContents threeLevels(Quantity water = Quantity::CloudLiquid) {
  MadeContents made;
  for (const double pressure : {500.0, 900.0, 700.0}) {
    made.isobaric(water, pressure, 1e-4f, "clwc");
    made.isobaric(Quantity::Temperature, pressure, 250.0f, "t");
  }
  return made;
}

TEST(ModelSource, LevelsComeFromTheGroundUpwards) {
  const auto source = makeSource(threeLevels().contents, {});
  EXPECT_EQ(source->telling(), field::Telling::Levels);
  std::vector<double> pressures;
  for (const field::Level& level : levelsOf(*source)) pressures.push_back(level.pressurePa);
  EXPECT_THAT(pressures, ElementsAre(90000, 70000, 50000));
  EXPECT_THAT(source->info().levels.values, ElementsAre(900, 700, 500));
  EXPECT_THAT(source->info().fields,
              Contains("cloud liquid water: clwc on 3 pressure levels, 900 to 500 hPa"));
}

TEST(ModelSource, TheWantedTimeIsTakenOrTheTimesThereAreAreNamed) {
  MadeContents made = threeLevels();
  const base::UtcTime later = base::utcFromCivil(2026, 6, 21, 18);
  made.time = later;
  made.isobaric(Quantity::CloudLiquid, 850, 2e-4f);
  const auto first = makeSource(made.contents, {});
  EXPECT_EQ(base::isoText(first->info().validTime), "2026-06-21T12:00:00Z");
  EXPECT_EQ(first->info().validTimes.size(), 2u);
  EXPECT_THAT(warningIds(*first), Contains("several_times"));
  const auto second = makeSource(made.contents, {.time = later});
  EXPECT_EQ(second->info().validTime, later);
  EXPECT_EQ(levelsOf(*second).size(), 1u);
  EXPECT_THAT(warningIds(*second), Not(Contains("several_times")));
  try {
    makeSource(made.contents, {.time = base::utcFromCivil(2030, 1, 1)});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.hint(), testing::HasSubstr("2026-06-21T12:00:00Z, 2026-06-21T18:00:00Z"));
  }
}

TEST(ModelSource, CloudMixingRatioIsLiquidWhereIceStandsApart) {
  MadeContents made = threeLevels(Quantity::CloudCondensate);
  EXPECT_THAT(warningIds(*makeSource(made.contents, {})), Contains("one_condensate"));
  made.isobaric(Quantity::CloudIce, 500, 1e-5f);
  const auto source = makeSource(made.contents, {});
  for (const field::Level& level : levelsOf(*source)) EXPECT_TRUE(level.has(Quantity::CloudLiquid));
  EXPECT_THAT(warningIds(*source), Not(Contains("one_condensate")));
}

TEST(ModelSource, LiquidThatHoldsIceIsIceBelowFreezing) {
  MadeContents made;
  for (const double pressure : {900.0, 500.0}) {
    made.isobaric(Quantity::CloudLiquid, pressure, 1e-4f).holdsIceBelowFreezing = true;
    made.isobaric(Quantity::Temperature, pressure, pressure == 900 ? 285.0f : 250.0f);
  }
  const auto levels = levelsOf(*makeSource(made.contents, {}));
  EXPECT_FLOAT_EQ(levels[0].of(Quantity::CloudLiquid)[0], 1e-4f);
  EXPECT_FLOAT_EQ(levels[0].of(Quantity::CloudIce)[0], 0);
  EXPECT_FLOAT_EQ(levels[1].of(Quantity::CloudLiquid)[0], 0);
  EXPECT_FLOAT_EQ(levels[1].of(Quantity::CloudIce)[0], 1e-4f);
}

struct Cover {
  const char* name;
  bool statedInPercent;
  float stored;
  float meant;
  const char* warning;  ///< or none
};

TEST(Traps, CoverIsTakenAsItsValuesSay) {
  for (const Cover& cover :
       {Cover{"per cent as stated", true, 60, 0.6f, nullptr},
        Cover{"fractions under a parameter in per cent", true, 0.6f, 0.6f, "cover_in_fractions"},
        Cover{"fractions as stated", false, 0.6f, 0.6f, nullptr},
        Cover{"per cent under a parameter of fractions", false, 60, 0.6f, "cover_in_percent"}}) {
    MadeContents made = threeLevels();
    made.isobaric(Quantity::CloudFraction, 900, cover.stored, "cc").inPercent = cover.statedInPercent;
    const auto source = makeSource(made.contents, {});
    EXPECT_NEAR(levelsOf(*source)[0].of(Quantity::CloudFraction)[0], cover.meant, 1e-6) << cover.name;
    const auto ids = warningIds(*source);
    if (cover.warning)
      EXPECT_THAT(ids, Contains(cover.warning)) << cover.name;
    else
      EXPECT_THAT(ids, Not(Contains(testing::StartsWith("cover_")))) << cover.name;
  }
}

TEST(ModelSource, HybridPressureIsMadeOfCoefficientsAndSurfacePressure) {
  MadeContents made;
  made.level(Quantity::CloudLiquid, {VerticalKind::Hybrid, 1, 10000, 0}, 1e-5f);
  made.level(Quantity::CloudLiquid, {VerticalKind::Hybrid, 2, 5000, 0.9}, 1e-5f);
  made.single(SingleKind::LogSurfacePressure, static_cast<float>(std::log(98000.0)));
  const auto source = makeSource(made.contents, {});
  const auto levels = levelsOf(*source);
  EXPECT_NEAR(levels[0].of(Quantity::Pressure)[3], 5000 + 0.9 * 98000, 5);
  EXPECT_NEAR(levels[1].of(Quantity::Pressure)[3], 10000, 1e-3);
  EXPECT_THAT(source->info().levels.values, ElementsAre(2, 1));
}

TEST(Traps, LevelsAreOrderedByTheirHeightsWhateverTheirNumbers) {
  for (const bool fromTop : {true, false}) {
    MadeContents made;
    for (int number = 1; number <= 3; ++number) {
      const Vertical vertical{VerticalKind::ModelLevel, static_cast<double>(number)};
      const float height = 1000.0f * static_cast<float>(fromTop ? 4 - number : number);
      made.level(Quantity::CloudLiquid, vertical, 1e-5f);
      made.level(Quantity::Height, vertical, height);
    }
    const auto source = makeSource(made.contents, {});
    std::vector<float> heights;
    for (const field::Level& level : levelsOf(*source)) heights.push_back(level.of(Quantity::Height)[0]);
    EXPECT_THAT(heights, ElementsAre(1000, 2000, 3000));
    EXPECT_EQ(testing::Matches(Contains("levels_from_bottom"))(warningIds(*source)), !fromTop);
  }
}

TEST(Traps, HeightsAboveTheGroundAreToldApart) {
  MadeContents made;
  for (const double height : {100.0, 500.0})
    made.level(Quantity::CloudLiquid, {VerticalKind::HeightAboveGround, height}, 1e-5f);
  made.single(SingleKind::SurfaceHeight, 800);
  const auto source = makeSource(made.contents, {});
  EXPECT_THAT(warningIds(*source), Contains("heights_above_ground"));
  EXPECT_FLOAT_EQ(levelsOf(*source)[1].of(Quantity::HeightAboveGround)[0], 500);
  EXPECT_FLOAT_EQ(source->surface(field::everyCell(source->grid())).heightMeters[0], 800);
}

TEST(Traps, NegativeCloudBaseMeansNoCloud) {
  MadeContents made = threeLevels(Quantity::RelativeHumidity);
  made.single(SingleKind::CloudBaseHeight, -4500);
  made.single(SingleKind::CloudTopHeight, 6000);
  const auto source = makeSource(made.contents, {});
  EXPECT_THAT(warningIds(*source), Contains("negative_cloud_height"));
  const field::Surface surface = source->surface(field::everyCell(source->grid()));
  EXPECT_TRUE(std::isnan(surface.cloudBaseMeters[0]));
  EXPECT_FLOAT_EQ(surface.cloudTopMeters[0], 6000);
}

TEST(Traps, AntimeridianPoleAndSphereAreNamed) {
  MadeContents made = threeLevels();
  made.contents.grids[0] = [] {
    field::Grid grid;
    grid.crs = "+proj=longlat +R=6370000";
    grid.columns = 4, grid.rows = 3;
    grid.firstX = 178, grid.firstY = 88, grid.stepX = grid.stepY = 1;
    return grid;
  };
  const auto ids = warningIds(*makeSource(made.contents, {}));
  EXPECT_THAT(ids, Contains("antimeridian_inside"));
  EXPECT_THAT(ids, Contains("pole_inside"));
  EXPECT_THAT(ids, Contains("sphere"));
}

TEST(CoverOnly, LowMiddleAndHighBecomeLayers) {
  MadeContents made;
  made.single(SingleKind::SurfaceHeight, 500);
  made.single(SingleKind::CloudCover, 40, CloudPart::Low).inPercent = true;
  made.single(SingleKind::CloudCover, 0, CloudPart::Middle).inPercent = true;
  made.single(SingleKind::CloudCover, 70, CloudPart::High).inPercent = true;
  made.single(SingleKind::CloudCover, 80, CloudPart::Total).inPercent = true;
  made.single(SingleKind::CloudBasePressure, 90000, CloudPart::Low);
  made.single(SingleKind::CloudTopPressure, 80000, CloudPart::Low);
  const auto source = makeSource(made.contents, {});
  EXPECT_EQ(source->telling(), field::Telling::Layers);
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 2u) << "total cover adds nothing, middle cover is none";
  EXPECT_NEAR(layers[0].coverFraction, 0.4, 1e-6);
  EXPECT_NEAR(layers[0].baseMeters, 988.5, 1) << "900 hPa in the standard atmosphere";
  EXPECT_NEAR(layers[0].topMeters, 1948.7, 1);
  EXPECT_NEAR(layers[1].coverFraction, 0.7, 1e-6);
  EXPECT_GT(layers[1].baseMeters, 6000);
  EXPECT_FALSE(layers[0].genus) << "the rules decide";
}

TEST(CoverOnly, ConvectionIsTakenFromTheLowCover) {
  MadeContents made;
  made.single(SingleKind::CloudCover, 0.5f, CloudPart::Low);
  made.single(SingleKind::CloudCover, 0.2f, CloudPart::Convective);
  made.single(SingleKind::CloudTopHeight, 9000, CloudPart::Convective);
  made.single(SingleKind::CloudBaseHeight, 1200, CloudPart::Convective);
  const auto layers = layersOf(*makeSource(made.contents, {}));
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_NEAR(layers[0].coverFraction, 0.3, 1e-6);
  EXPECT_EQ(layers[1].genus, base::Genus::Cumulonimbus);
}

TEST(CoverOnly, TotalCoverAloneIsOneLayer) {
  MadeContents made;
  made.single(SingleKind::CloudCover, 0.8f);
  ASSERT_EQ(layersOf(*makeSource(made.contents, {})).size(), 1u);
}

TEST(ModelSource, FewHumidityLevelsYieldToTheModelsOwnCover) {
  MadeContents made = threeLevels(Quantity::RelativeHumidity);
  EXPECT_EQ(makeSource(made.contents, {})->telling(), field::Telling::Levels);
  made.single(SingleKind::CloudCover, 0.8f, CloudPart::High);
  EXPECT_EQ(makeSource(made.contents, {})->telling(), field::Telling::Layers);
}

TEST(ModelSource, WhatSaysNothingOfCloudsIsRefusedByName) {
  MadeContents made;
  made.isobaric(Quantity::Temperature, 500, 250, "t");
  made.isobaric(Quantity::WindEast, 500, 3, "u");
  try {
    makeSource(made.contents, {});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_STREQ(error.problem().c_str(), "says nothing about clouds; it holds t, u");
  }
}

}  // namespace
}  // namespace cloudgen::input::model
