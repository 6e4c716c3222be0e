// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "input/catalogue.hpp"
#include "input/cdfs/raw_files.hpp"
#include "unit/input/cdfs_support.hpp"

namespace cloudgen::input {
namespace {

const OneLayer kHighCloud{.type = 8, .base = 0, .top = 10500, .ageMinutes = 30};

TEST(WwmcaRaw, IsKnownByItsNameAlone) {
  const auto file = cdfs::rawFileOf("somewhere/WWMCA_LYRD_CLOUD_TYPE_SH_2011011512");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->field, cdfs::RawField::Type);
  EXPECT_EQ(file->half, cdfs::Hemisphere::South);
  EXPECT_EQ(file->time, kNoon);
  EXPECT_TRUE(cdfs::rawFileOf("WWMCA_PIXL_TIME_MEANS_NH_2011011512.bin"));
  for (const char* name : {"WWMCA_LYRD_CLOUD_TYPE_XH_2011011512", "WWMCA_LYRD_CLOUD_TYPE_NH_2011011532",
                           "WWMCA_LYRD_CLOUD_TYPE_NH_20110115", "WWMCA_LYRD_CLOUD_TYPE_NH_2011011512x", "x"})
    EXPECT_FALSE(cdfs::rawFileOf(name)) << name;
}

TEST(WwmcaRaw, ReadsBothByteOrdersTheSameAndSaysWhich) {
  const test::MadeAnalysis made = analysisWith({OneLayer{}, kHighCloud, {.type = 4, .column = 4, .row = 7}});
  const auto big = fromRaw(made, std::endian::big), little = fromRaw(made, std::endian::little);
  EXPECT_EQ(warningOf(*big, "byte_order"), "");
  EXPECT_TRUE(says(big->info().fields, "big-endian, told by its times"));
  EXPECT_NE(warningOf(*little, "byte_order").find("little-endian"), std::string::npos);
  const auto first = layersOf(*big), second = layersOf(*little);
  ASSERT_EQ(first.size(), 2u);
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].topMeters, second[i].topMeters);
    EXPECT_EQ(first[i].ageMinutes, second[i].ageMinutes);
  }
}

TEST(WwmcaRaw, TellsTheByteOrderByHeightsWhereThereAreNoTimes) {
  const test::Scratch scratch;
  auto files = test::writeWwmcaRaw(analysisWith({OneLayer{}}), scratch.path(), std::endian::little);
  files.erase(files.begin() + 3);
  const auto source = openCdfs(files, {}, kSmall);
  EXPECT_NE(warningOf(*source, "byte_order").find("told by its heights"), std::string::npos);
  EXPECT_EQ(layersOf(*source).front().topMeters, 1500);
}

TEST(WwmcaRaw, ObeysTheByteOrderThatIsAskedFor) {
  const test::MadeAnalysis made = analysisWith({OneLayer{}});
  OpenOptions options;
  options.byteOrder = std::endian::little;
  EXPECT_EQ(layersOf(*fromRaw(made, std::endian::little, options)).size(), 1u);
  EXPECT_NE(
      complaintOf([&] { fromRaw(made, std::endian::big, options); }).find("byte order that was asked for"),
      std::string::npos);
}

TEST(WwmcaRaw, TakesTheBaseAsTheTopMinusADepthByType) {
  const auto source = fromRaw(analysisWith({kHighCloud}));
  EXPECT_TRUE(says(source->info().missing, "cloud base"));
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers.front().genus, base::Genus::Cirrostratus);
  EXPECT_EQ(layers.front().topMeters, 10500);
  EXPECT_GT(layers.front().baseMeters, 8000);
  EXPECT_LT(layers.front().baseMeters, 10000);
  EXPECT_EQ(layers.front().ageMinutes, 30);
  EXPECT_EQ(layers.front().iceShare, 1);
}

TEST(WwmcaRaw, ChecksSizesToTheByte) {
  const test::Scratch scratch;
  const auto files = test::writeWwmcaRaw(analysisWith({OneLayer{}}), scratch.path());
  for (const auto& file : files) {
    const auto size = std::filesystem::file_size(file);
    for (const auto other : {size - 1, size + 1}) {
      std::filesystem::resize_file(file, other);
      const std::string text = complaintOf([&] { openCdfs(files, {}, kSmall); });
      EXPECT_NE(text.find("are due"), std::string::npos) << text;
      std::filesystem::resize_file(file, size);
    }
  }
}

TEST(WwmcaRaw, ReadsAFolderOfTheSixteenthMesh) {
  const test::Scratch scratch;
  test::MadeAnalysis made = test::clearAnalysis(false, kNoon);
  put(made, {.type = 4, .top = 2500, .column = 300, .row = 400});
  test::writeWwmcaRaw(made, scratch.path());
  scratch.write("README", "hello");
  const auto source = open({scratch.path()});
  EXPECT_EQ(source->info().format, "WWMCA raw binary");
  EXPECT_EQ(source->info().files.size(), 5u);
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers.front().cell, source->grid().index(300, 400));
}

TEST(WwmcaRaw, RefusesTimesThatFitNeitherOrder) {
  const test::Scratch scratch;
  const auto files = test::writeWwmcaRaw(analysisWith({OneLayer{}}), scratch.path());
  scratch.write(files[3].filename(), std::string(kSmall * kSmall * 4, '\x55'));
  EXPECT_NE(complaintOf([&] { openCdfs(files, {}, kSmall); }).find("in either byte order"),
            std::string::npos);
}

TEST(WwmcaRaw, ComparesTheTotalCoverWithTheLayers) {
  test::MadeAnalysis made = analysisWith({OneLayer{}});
  EXPECT_EQ(warningOf(*fromRaw(made), "total_cover"), "");
  made.totalCover[made.slot(9, 9, 0) / 4] = 20;
  const std::string text = warningOf(*fromRaw(made), "total_cover");
  EXPECT_NE(text.find("in 1 of 256 cells, by 40.0 %"), std::string::npos) << text;
}

}  // namespace
}  // namespace cloudgen::input
