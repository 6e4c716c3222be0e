// SPDX-License-Identifier: Apache-2.0
#include <eccodes.h>
#include <gtest/gtest.h>

#include "input/catalogue.hpp"
#include "unit/input/cdfs_support.hpp"

namespace cloudgen::input {
namespace {

TEST(WwmcaGrib, IsKnownByItsFirstMessageWhateverItsName) {
  const test::Scratch scratch;
  const auto file = scratch.write("anything", test::wwmcaGrib(analysisWith({OneLayer{}})));
  const auto source = open({file});
  EXPECT_EQ(source->info().format, "WWMCA GRIB1");
  EXPECT_EQ(source->telling(), field::Telling::Layers);
  EXPECT_EQ(source->info().validTime, kNoon);
  EXPECT_EQ(source->grid().columns, kSmall);
  EXPECT_FALSE(isCdfs("anything", test::wwmcaGrib(analysisWith({})).substr(0, 20)));
}

TEST(WwmcaGrib, TellsWhatEachLayerSays) {
  const auto source = fromGrib(analysisWith({OneLayer{}}));
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 1u);
  const field::StatedLayer& layer = layers.front();
  EXPECT_EQ(layer.cell, source->grid().index(9, 9));
  EXPECT_EQ(layer.genus, base::Genus::Stratocumulus);
  EXPECT_FLOAT_EQ(layer.coverFraction, 0.6f);
  EXPECT_EQ(layer.baseMeters, 900);
  EXPECT_EQ(layer.topMeters, 1500);
  EXPECT_FLOAT_EQ(layer.opticalDepth, 9);
  EXPECT_EQ(layer.iceShare, 0);
}

TEST(WwmcaGrib, TellsLayersUpwardsHoweverTheyFloat) {
  const auto layers = layersOf(*fromGrib(analysisWith({{.type = 9, .base = 9000, .top = 10000, .layer = 0},
                                                       {.type = 4, .base = 800, .top = 2000, .layer = 2},
                                                       {.type = 7, .base = 4000, .top = 5000, .layer = 3}})));
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].genus, base::Genus::Cumulus);
  EXPECT_EQ(layers[1].genus, base::Genus::Altocumulus);
  EXPECT_EQ(layers[2].genus, base::Genus::Cirrus);
}

TEST(WwmcaGrib, DividesOpticalDepthsByTenAndSaysSo) {
  const std::string text = warningOf(*fromGrib(analysisWith({OneLayer{}})), "optical_depth_x10");
  EXPECT_NE(text.find("from 90 to 9"), std::string::npos) << text;
}

TEST(WwmcaGrib, JoinsTheHemispheresAndLeavesOutWhatLiesBeyondTheEquator) {
  const test::Scratch scratch;
  const OneLayer corner{.column = 0, .row = 0};
  const auto north = test::writeWwmcaGrib(analysisWith({OneLayer{}, corner}), scratch.path());
  const auto south = test::writeWwmcaGrib(analysisWith({{.type = 2}, corner}, true), scratch.path());
  EXPECT_EQ(layersOf(*openCdfs({north}, {})).size(), 2u) << "one hemisphere is told whole";
  const auto pair = openCdfs({south, north}, {});
  EXPECT_EQ(pair->grid().rows, 2 * kSmall);
  const auto layers = layersOf(*pair);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].genus, base::Genus::Stratocumulus);
  EXPECT_EQ(layers[1].genus, base::Genus::Stratus);
  EXPECT_LT(field::centerOf(pair->grid(), layers[1].cell).latitudeDegrees, 0);
}

TEST(WwmcaGrib, TakesTheHourThatIsAskedForAndNamesThoseThereAre) {
  const test::Scratch scratch;
  test::MadeAnalysis later = analysisWith({{.type = 2}});
  later.time = base::utcFromCivil(2011, 1, 15, 13);
  const std::vector files{test::writeWwmcaGrib(later, scratch.path()),
                          test::writeWwmcaGrib(analysisWith({OneLayer{}}), scratch.path())};
  EXPECT_EQ(openCdfs(files, {})->info().validTime, kNoon);
  EXPECT_EQ(openCdfs(files, {})->info().validTimes.size(), 2u);
  OpenOptions options;
  options.time = later.time;
  EXPECT_EQ(layersOf(*openCdfs(files, options)).front().genus, base::Genus::Stratus);
  options.time = base::utcFromCivil(2011, 1, 16);
  const std::string text = complaintOf([&] { openCdfs(files, options); });
  EXPECT_NE(text.find("there is 2011-01-15T12:00:00Z, 2011-01-15T13:00:00Z"), std::string::npos) << text;
}

TEST(WwmcaGrib, SaysWhatIsMissingAndAssumed) {
  const test::Scratch scratch;
  const test::MadeAnalysis made = analysisWith({OneLayer{}});
  std::string bytes;
  for (const int parameter : {163, 228})
    for (int layer = 1; layer <= 4; ++layer) bytes += test::wwmcaMessage(made, parameter, layer);
  const auto source = openCdfs({scratch.write("few", bytes)}, {});
  const auto& missing = source->info().missing;
  EXPECT_TRUE(says(missing, "cloud type"));
  EXPECT_TRUE(says(missing, "cloud base"));
  EXPECT_TRUE(says(missing, "optical depth"));
  EXPECT_TRUE(says(missing, "times of update"));
  EXPECT_TRUE(says(missing, "fog"));
  EXPECT_NE(warningOf(*source, "heights_assumed_msl"), "");
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_FALSE(layers.front().genus);
  EXPECT_LT(layers.front().baseMeters, 1500);
}

TEST(WwmcaGrib, RefusesFilesThatCannotMakeClouds) {
  const test::Scratch scratch;
  const test::MadeAnalysis made = analysisWith({OneLayer{}});
  const auto complaint = [&](const std::string& bytes) {
    return complaintOf([&] { openCdfs({scratch.write("file", bytes)}, {}); });
  };
  EXPECT_NE(complaint(test::wwmcaMessage(made, 164, 1)).find("no cloud amounts"), std::string::npos);
  EXPECT_NE(complaint(test::wwmcaMessage(made, 163, 1)).find("no heights"), std::string::npos);
  const std::string twice = test::wwmcaMessage(made, 163, 1);
  EXPECT_NE(complaint(twice + twice).find("repeats"), std::string::npos);
}

/// A message of edition 2 on layer 1 of the mesh of 16 x 16 cells: category 6, the same value everywhere.
std::string message2(long number, double value) {
  codes_handle* handle = codes_grib_handle_new_from_samples(nullptr, "polar_stereographic_sfc_grib2");
  const auto whole = [&](const char* key, long to) { codes_set_long(handle, key, to); };
  whole("centre", 57);
  whole("discipline", 0);
  whole("parameterCategory", 6);
  whole("parameterNumber", number);
  whole("typeOfFirstFixedSurface", 105);
  whole("scaleFactorOfFirstFixedSurface", 0);
  whole("scaledValueOfFirstFixedSurface", 1);
  whole("Nx", kSmall);
  whole("Ny", kSmall);
  codes_set_double(handle, "latitudeOfFirstGridPointInDegrees", -20.826);
  codes_set_double(handle, "longitudeOfFirstGridPointInDegrees", 145);
  codes_set_double(handle, "orientationOfTheGridInDegrees", 280);
  codes_set_double(handle, "DxInMetres", 1524000);
  codes_set_double(handle, "DyInMetres", 1524000);
  whole("dataDate", 20110115);
  whole("dataTime", 1200);
  const std::vector<double> values(kSmall * kSmall, value);
  codes_set_double_array(handle, "values", values.data(), values.size());
  const void* bytes = nullptr;
  std::size_t length = 0;
  codes_get_message(handle, &bytes, &length);
  std::string message(static_cast<const char*>(bytes), length);
  codes_handle_delete(handle);
  return message;
}

TEST(WwmcaGrib, ReadsTheTableOfTheWmoInEdition2) {
  const test::Scratch scratch;
  for (const auto& [code, genus] : {std::pair{9.0, base::Genus::Cirrocumulus}, {20.0, base::Genus::Cirrus}}) {
    const auto file = scratch.write(
        "edition2", message2(8, code) + message2(22, 40) + message2(11, 8000) + message2(12, 9000));
    const auto source = open({file});
    EXPECT_EQ(source->info().format, "WWMCA GRIB2");
    EXPECT_TRUE(says(source->info().fields, "WMO 4.203"));
    const auto layers = layersOf(*source);
    ASSERT_EQ(layers.size(), static_cast<std::size_t>(kSmall * kSmall));
    EXPECT_EQ(layers.front().genus, genus);
    EXPECT_FLOAT_EQ(layers.front().coverFraction, 0.4f);
    EXPECT_EQ(layers.front().topMeters, 9000);
    EXPECT_EQ(warningOf(*source, "ground_fog").empty(), code < 11);
  }
}

TEST(WwmcaGrib, RefusesAnyTruncation) {
  const test::Scratch scratch;
  const std::string whole = test::wwmcaGrib(analysisWith({OneLayer{}}));
  for (std::size_t size = 1; size < whole.size(); size += 97) {
    const auto file = scratch.write("cut", whole.substr(0, size));
    const std::string text = complaintOf([&] { layersOf(*openCdfs({file}, {})); });
    // A cut between messages leaves a file that is whole, but with fewer fields.
    EXPECT_TRUE(text != "nothing" || whole.substr(size - 4, 4) == "7777") << size;
  }
}

}  // namespace
}  // namespace cloudgen::input
