// SPDX-License-Identifier: Apache-2.0
#include <eccodes.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/file.hpp"
#include "field/collect.hpp"
#include "input/catalogue.hpp"
#include "support/made_grib.hpp"
#include "support/scratch.hpp"

namespace cloudgen {
namespace {

namespace fs = std::filesystem;

const fs::path kGfs = fs::path(CLOUDGEN_SHARED_DIR) / "data" / "gfs_2p5_20110110_f120.grib2";

#define SKIP_WITHOUT(file) \
  if (!fs::exists(file)) GTEST_SKIP() << "no " << (file)

TEST(RealGfs, SaysWhatItIs) {
  SKIP_WITHOUT(kGfs);
  const auto source = input::open({kGfs});
  EXPECT_EQ(source->info().format, "GRIB2");
  EXPECT_EQ(source->info().model, "NCEP GFS");
  EXPECT_EQ(base::isoText(*source->info().run), "2011-01-10T12:00:00Z");
  EXPECT_EQ(base::isoText(source->info().validTime), "2011-01-15T12:00:00Z");
  EXPECT_EQ(source->info().levels.values.size(), 21u);
  EXPECT_EQ(source->info().levels.values.front(), 1000);
  EXPECT_EQ(source->info().levels.values.back(), 100);
  EXPECT_EQ(source->grid().columns, 144);
  EXPECT_EQ(source->grid().rows, 73);
  EXPECT_TRUE(source->grid().wrapsLongitude);
  EXPECT_DOUBLE_EQ(source->grid().firstY, 90);
  EXPECT_DOUBLE_EQ(source->grid().stepY, -2.5);
  EXPECT_EQ(source->telling(), field::Telling::Levels);
}

/// Corners and middle against ecCodes' own arrays of latitude and longitude.
TEST(RealGfs, CellsLieWhereEcCodesPutsThem) {
  SKIP_WITHOUT(kGfs);
  const auto source = input::open({kGfs});
  std::FILE* file = std::fopen(kGfs.c_str(), "rb");
  int error = 0;
  codes_handle* handle = codes_handle_new_from_file(nullptr, file, PRODUCT_GRIB, &error);
  ASSERT_TRUE(handle);
  std::vector<double> latitudes(source->grid().size()), longitudes(source->grid().size());
  std::size_t count = latitudes.size();
  ASSERT_EQ(codes_get_double_array(handle, "latitudes", latitudes.data(), &count), 0);
  ASSERT_EQ(codes_get_double_array(handle, "longitudes", longitudes.data(), &count), 0);
  codes_handle_delete(handle);
  std::fclose(file);
  for (const std::uint32_t index : {0u, 143u, 144u * 36 + 72, 144u * 72, 144u * 73 - 1}) {
    const auto point = field::centerOf(source->grid(), index);
    EXPECT_NEAR(point.latitudeDegrees, latitudes[index], 1e-6) << index;
    EXPECT_NEAR(point.longitudeDegrees, base::wrappedLongitude(longitudes[index]), 1e-6) << index;
  }
}

TEST(RealGfs, HasPlausibleCloudsOverTheNorthAtlantic) {
  SKIP_WITHOUT(kGfs);
  const auto source = input::open({kGfs});
  const auto cells = field::cellsTouching(source->grid(), {-100, 25, -60, 50});
  ASSERT_EQ(cells.size(), 17u * 11u);
  const auto columns = field::collectColumns(*source, cells);
  EXPECT_GE(columns.derived.size(), 2u) << "cloud fraction, liquid and ice";
  ASSERT_EQ(columns.start.size(), cells.size() + 1);
  int cloudy = 0;
  double thickest = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    double opticalDepth = 0;
    float lastTop = -1000;
    for (std::uint32_t k = columns.start[c]; k < columns.start[c + 1]; ++k) {
      const auto& cell = columns.cells[k];
      EXPECT_GE(cell.baseMeters, lastTop - 1);
      EXPECT_GT(cell.topMeters, cell.baseMeters);
      EXPECT_LT(cell.topMeters, 20000);
      EXPECT_GE(cell.baseMeters, columns.states[c].surfaceHeightMeters);
      EXPECT_GE(cell.fraction, 0.01f);
      EXPECT_LE(cell.fraction, 1.0f);
      EXPECT_GT(cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter, 0);
      EXPECT_LT(cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter, 0.4f);
      opticalDepth +=
          (cell.liquidExtinctionPerMeter + cell.iceExtinctionPerMeter) * (cell.topMeters - cell.baseMeters);
      lastTop = cell.topMeters;
    }
    cloudy += columns.start[c + 1] > columns.start[c];
    thickest = std::max(thickest, opticalDepth);
    EXPECT_GT(columns.states[c].kIndexC, -100);
    EXPECT_LT(columns.states[c].kIndexC, 60);
  }
  EXPECT_GT(cloudy, 50);
  EXPECT_GT(thickest, 5);
  EXPECT_LT(thickest, 500);
}

TEST(RealGfs, CutShortAnywhereItSaysSoOrReadsWhatIsWhole) {
  SKIP_WITHOUT(kGfs);
  const std::string whole = base::readFile(kGfs);
  const test::Scratch scratch;
  int failed = 0;
  for (std::size_t part = 0; part < 50; ++part) {
    const fs::path file = scratch.write("cut.grib2", whole.substr(0, whole.size() * part / 50 + part));
    try {
      const auto source = input::open({file});
      field::collectColumns(*source, field::cellsTouching(source->grid(), {-10, 40, 10, 60}));
    } catch (const base::InputError& error) {
      ++failed;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(failed, 50);
}

struct RealFile {
  const char *file, *model, *crs, *levels;
  std::size_t cells, levelCount;
  field::Telling telling;
};

class RealGrib : public testing::TestWithParam<RealFile> {};

TEST_P(RealGrib, IsReadWithItsGridAndLevels) {
  const RealFile& expected = GetParam();
  const fs::path file = fs::path(CLOUDGEN_SHARED_DIR) / "data" / expected.file;
  SKIP_WITHOUT(file);
  const auto source = input::open({file});
  EXPECT_EQ(source->info().model, expected.model);
  EXPECT_EQ(source->info().levels.kind, expected.levels);
  EXPECT_EQ(source->info().levels.values.size(), expected.levelCount);
  EXPECT_EQ(source->grid().size(), expected.cells);
  EXPECT_TRUE(source->grid().crs.starts_with(expected.crs)) << source->grid().crs;
  EXPECT_EQ(source->telling(), expected.telling);
}

constexpr auto kLevels = field::Telling::Levels, kLayers = field::Telling::Layers;
INSTANTIATE_TEST_SUITE_P(
    All, RealGrib,
    testing::Values(RealFile{"eta_g211_lambert_20041208_f24.grib2", "NCEP NAM",
                             "+proj=lcc +lat_1=25 +lat_2=25", "pressure", 93 * 65, 19, kLevels},
                    RealFile{"ruc13_g212_2005080700_f00.grb", "NOAA RUC", "+proj=lcc +lat_1=25 +lat_2=25",
                             "pressure", 185 * 129, 39, kLevels},
                    RealFile{"ifs_oper_20240101_10msgs.grib2", "ECMWF IFS", "+proj=longlat", "pressure",
                             900 * 451, 3, kLevels},
                    RealFile{"wafs_thinned_reduced_ll_20070110.grib2", "NCEP GFS", "+proj=longlat",
                             "pressure", 3447, 11, kLevels},
                    RealFile{"cfs_flux_regular_gg_20060331.grb", "NCEP GFS", "+proj=longlat", "", 192 * 94, 0,
                             kLayers},
                    RealFile{"icon-eu_CLCT_MOD_20220427_f047.grib2", "DWD ICON", "+proj=longlat", "",
                             1097 * 657, 0, kLayers}));

TEST(RealGrib, HoursInFilesOfTheirOwnAreOneTimeSeries) {
  std::vector<fs::path> files;
  for (const char* hour : {"24", "00", "12"})
    files.push_back(fs::path(CLOUDGEN_SHARED_DIR) / "data" /
                    (std::string("ruc13_g212_2005080700_f") + hour + ".grb"));
  SKIP_WITHOUT(files.front());
  const auto source = input::open(files, {.time = base::utcFromIso("2005-08-07T12:00Z")});
  EXPECT_EQ(source->info().validTimes.size(), 3u);
  EXPECT_EQ(base::isoText(source->info().validTime), "2005-08-07T12:00:00Z");
}

TEST(MadeGrib, BothEditionsGiveBackWhatWasPutIn) {
  for (const int edition : {1, 2}) {
    const test::Scratch scratch;
    std::string bytes;
    for (const int level : {1000, 850, 700}) {
      test::GribField field{edition, level};
      bytes += test::made(
          field.with(test::Variable::CloudWater, [&](int i) { return level == 850 && i == 5 ? 4e-4 : 0; }));
      bytes +=
          test::made(field.with(test::Variable::Temperature, [&](int) { return 280.0 + level / 100.0; }));
      bytes += test::made(field.with(test::Variable::Height, [&](int) { return 9000.0 - 8.8 * level; }));
      bytes += test::made(field.with(test::Variable::Humidity, [&](int) { return 99; }));
    }
    const auto source = input::open({scratch.write("made.grib", bytes)});
    EXPECT_EQ(source->info().format, edition == 1 ? "GRIB1" : "GRIB2");
    const auto& grid = source->grid();
    ASSERT_EQ(grid.size(), 12u);
    EXPECT_FALSE(grid.wrapsLongitude);
    EXPECT_DOUBLE_EQ(grid.firstY, 50);
    EXPECT_DOUBLE_EQ(grid.stepX, 2);
    std::vector<std::uint32_t> cells(12);
    for (std::uint32_t i = 0; i < 12; ++i) cells[i] = i;
    const auto columns = field::collectColumns(*source, cells);
    ASSERT_EQ(columns.cells.size(), 1u) << "edition " << edition;
    EXPECT_EQ(columns.start[5], 0u);
    EXPECT_EQ(columns.start[6], 1u);
    EXPECT_EQ(columns.cells[0].pressurePa, 85000);
    EXPECT_NEAR(columns.cells[0].temperatureK, 288.5, 0.01);
    EXPECT_NEAR(columns.cells[0].relativeHumidity, 0.99, 1e-3);
  }
}

TEST(MadeGrib, MissingPointsAreMissing) {
  const test::Scratch scratch;
  test::GribField field{2, 500};
  field.missing = {3};
  const fs::path file = scratch.write(
      "made.grib", test::made(field.with(test::Variable::CloudWater, [](int i) { return i * 1e-4; })));
  const auto source = input::open({file});
  const std::vector<std::uint32_t> cells{2, 3, 4};
  source->visitLevels(cells, [](const field::Level& level) {
    EXPECT_EQ(level.pressurePa, 50000);
    const auto values = level.of(field::Quantity::CloudCondensate);
    EXPECT_NEAR(values[0], 2e-4, 1e-6);
    EXPECT_TRUE(std::isnan(values[1]));
    EXPECT_NEAR(values[2], 4e-4, 1e-6);
  });
}

TEST(MadeGrib, OfSeveralTimesTheFirstIsTakenAndTheOthersNamed) {
  const test::Scratch scratch;
  test::GribField early{2, 500}, late{2, 500};
  late.hour = 18;
  const std::string bytes = test::made(late.with(test::Variable::CloudWater, [](int) { return 1e-4; })) +
                            test::made(early.with(test::Variable::CloudWater, [](int) { return 2e-4; }));
  const auto source = input::open({scratch.write("made.grib", bytes)});
  EXPECT_EQ(base::isoText(source->info().validTime), "2020-06-01T12:00:00Z");
  bool named = false;
  for (const auto& [id, warning] : source->info().warnings)
    named |= warning.find("2020-06-01T18:00:00Z") != std::string::npos;
  EXPECT_TRUE(named);
}

TEST(MadeGrib, DamageIsNamedWithItsMessage) {
  const test::Scratch scratch;
  const std::string good =
      test::made(test::GribField{2, 500}.with(test::Variable::CloudWater, [](int) { return 1e-4; }));
  std::string noEnd = good;
  noEnd[noEnd.size() - 1] = 'X';
  std::string badSection = good;
  badSection[16] = '\x7f';
  std::string absurd = good;
  absurd[8] = '\x7f';
  for (const std::string& bad : {noEnd, badSection, absurd, good.substr(0, 100)}) {
    try {
      input::open({scratch.write("bad.grib", good + bad)});
      ADD_FAILURE() << "read";
    } catch (const base::InputError& error) {
      EXPECT_NE(error.where().find("message 2 at byte " + std::to_string(good.size())), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace cloudgen
