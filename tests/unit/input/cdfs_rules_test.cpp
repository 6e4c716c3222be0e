// SPDX-License-Identifier: Apache-2.0
#include "input/cdfs/rules.hpp"

#include <gtest/gtest.h>

#include "unit/input/cdfs_support.hpp"

namespace cloudgen::input {
namespace {

using base::Genus;

bool isKept(int baseMeters, int topMeters, int ageMinutes) {
  const auto source =
      fromGrib(analysisWith({{.type = 3, .base = baseMeters, .top = topMeters, .ageMinutes = ageMinutes}}));
  const bool kept = layersOf(*source).size() == 1;
  EXPECT_EQ(warningOf(*source, "stale_typing").empty(), kept);
  return kept;
}

TEST(CdfsRules, DropLowCloudAfterThreeHoursAndOtherCloudAfterSix) {
  EXPECT_TRUE(isKept(1999, 3000, 180));
  EXPECT_FALSE(isKept(1999, 3000, 181));
  EXPECT_TRUE(isKept(2000, 3000, 181));
  EXPECT_TRUE(isKept(7000, 8000, 360));
  EXPECT_FALSE(isKept(7000, 8000, 361));
}

TEST(CdfsRules, CountWhatTheyDrop) {
  const auto source = fromGrib(analysisWith({{.base = 900, .top = 1500, .ageMinutes = 200},
                                             {.base = 7000, .top = 8000, .ageMinutes = 400, .column = 3},
                                             {.column = 4}}));
  const std::string text = warningOf(*source, "stale_typing");
  EXPECT_NE(text.find("2 of 3 layers"), std::string::npos) << text;
  EXPECT_NE(text.find("1 low ones"), std::string::npos) << text;
  EXPECT_EQ(layersOf(*source).size(), 1u);
}

TEST(CdfsRules, DropWhatWasNeverObserved) {
  test::MadeAnalysis made = analysisWith({OneLayer{}, {.column = 4}});
  const test::Scratch scratch;
  auto files = test::writeWwmcaRaw(made, scratch.path());
  std::string times = base::readFile(files[3]);
  times.replace(made.slot(4, 9, 0), 4, std::string(4, '\0'));
  scratch.write(files[3].filename(), times);
  const auto source = openCdfs(files, {}, kSmall);
  EXPECT_EQ(layersOf(*source).size(), 1u);
  EXPECT_NE(warningOf(*source, "stale_typing").find("1 never observed"), std::string::npos);
}

TEST(CdfsRules, KnowTheLeastTopOfCumulonimbusByLatitude) {
  EXPECT_EQ(cdfs::leastCumulonimbusTop(0), 12600);
  EXPECT_EQ(cdfs::leastCumulonimbusTop(-9.9), 12600);
  EXPECT_EQ(cdfs::leastCumulonimbusTop(10), 12300);
  EXPECT_EQ(cdfs::leastCumulonimbusTop(-30), 12000);
  EXPECT_EQ(cdfs::leastCumulonimbusTop(59), 11700);
  EXPECT_EQ(cdfs::leastCumulonimbusTop(75), 11400);
}

TEST(CdfsRules, TakeLowCumulonimbusAsCumulusAsDeep) {
  // Cell (8, 8) is the pole, (8, 6) lies at 62 degrees or so.
  const auto source = fromGrib(analysisWith({{.type = 1, .base = 800, .top = 11400, .column = 8, .row = 8},
                                             {.type = 1, .base = 800, .top = 11401, .column = 7, .row = 8}}));
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].genus, Genus::Cumulonimbus);
  EXPECT_EQ(layers[1].genus, Genus::Cumulus);
  EXPECT_EQ(layers[1].topMeters, 11400);
  EXPECT_NE(warningOf(*source, "cb_taken_as_cu").find("1 layers"), std::string::npos);
}

TEST(CdfsRules, UseTheLatitudeOfTheCell) {
  for (int row = 0; row < 9; ++row) {
    const double latitude = test::meshCenter(kSmall, false, 8, row).latitudeDegrees;
    if (latitude < 0) continue;
    const int limit = static_cast<int>(cdfs::leastCumulonimbusTop(latitude));
    const auto genusAt = [&](int top) {
      const OneLayer layer{.type = 1, .base = 800, .top = top, .column = 8, .row = row};
      return layersOf(*fromGrib(analysisWith({layer}))).front().genus;
    };
    EXPECT_EQ(genusAt(limit), Genus::Cumulus) << latitude;
    EXPECT_EQ(genusAt(limit + 1), Genus::Cumulonimbus) << latitude;
  }
}

TEST(CdfsRules, SayEachCodeThatTheTableDoesNotHave) {
  const auto source = fromGrib(analysisWith(
      {{.type = 10}, {.type = 13, .column = 3}, {.type = 255, .column = 4}, {.type = 25, .column = 5}}));
  std::string all;
  for (const field::Warning& warning : source->info().warnings) all += warning.text + "\n";
  EXPECT_NE(all.find("code 10, which the AFWA table does not have (in the WMO 4.203 table it is Ci)"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("code 13"), std::string::npos);
  EXPECT_NE(all.find("code 255"), std::string::npos);
  EXPECT_NE(warningOf(*source, "type_not_filled"), "");
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 4u);
  for (const field::StatedLayer& layer : layers) EXPECT_FALSE(layer.genus);
}

TEST(CdfsRules, KeepTheTwoTablesApart) {
  using cdfs::TypeTable;
  EXPECT_EQ(cdfs::kindOf(TypeTable::Afwa, 9).genus, Genus::Cirrus);
  EXPECT_EQ(cdfs::kindOf(TypeTable::Wmo, 9).genus, Genus::Cirrocumulus);
  EXPECT_EQ(cdfs::kindOf(TypeTable::Wmo, 10).genus, Genus::Cirrus);
  EXPECT_EQ(cdfs::kindOf(TypeTable::Wmo, 13).genus, Genus::Stratocumulus);
  EXPECT_TRUE(cdfs::kindOf(TypeTable::Wmo, 13).aboveFog);
  EXPECT_FALSE(cdfs::kindOf(TypeTable::Afwa, 10).inTable);
  EXPECT_FALSE(cdfs::kindOf(TypeTable::Wmo, 25).inTable);
  for (std::uint8_t code = 1; code <= 8; ++code)
    EXPECT_EQ(cdfs::kindOf(TypeTable::Afwa, code).genus, cdfs::kindOf(TypeTable::Wmo, code).genus);
  for (std::uint8_t code = 1; code <= 9; ++code)
    EXPECT_EQ(cdfs::afwaCode(*cdfs::kindOf(TypeTable::Afwa, code).genus), code);
}

TEST(CdfsRules, DropAmountsOverAHundredAndLayersWithoutAHeight) {
  const auto source = fromGrib(analysisWith(
      {{.amount = 120}, {.base = 0, .top = 0, .column = 3}, {.base = -9, .top = 26000, .column = 4}}));
  EXPECT_TRUE(layersOf(*source).empty());
  EXPECT_NE(warningOf(*source, "amount_too_large").find("1 layers"), std::string::npos);
  EXPECT_NE(warningOf(*source, "no_height").find("2 layers"), std::string::npos);
}

TEST(CdfsRules, NeverTellALayerUpsideDown) {
  for (int type = 0; type <= 9; ++type)
    for (const int top : {1, 30, 200, 1000, 3000, 9000, 20000}) {
      const auto layers = layersOf(*fromRaw(analysisWith({{.type = type, .base = 0, .top = top}})));
      ASSERT_EQ(layers.size(), 1u);
      EXPECT_LT(layers.front().baseMeters, layers.front().topMeters);
      EXPECT_GE(layers.front().baseMeters, 0);
      EXPECT_GT(layers.front().opticalDepth, 0);
    }
}

}  // namespace
}  // namespace cloudgen::input
