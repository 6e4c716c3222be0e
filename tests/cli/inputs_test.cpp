// SPDX-License-Identifier: Apache-2.0
// Real model files through inspect and build without a special flag, and what each gave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/fits_schema.hpp"
#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using nlohmann::json;

/// A file, and what a forecaster must find in it. Of a time series the first: AnHourAFileIsOneInput reads the others.
struct Input {
  const char* file;
  const char* tells;   ///< levels or layers
  std::size_t levels;  ///< that clouds are taken from
  std::size_t times;
  const char* gridCrs;                  ///< part of the projection
  std::vector<const char*> derived;     ///< words that the report must say about what was derived
  std::vector<const char*> warningIds;  ///< traps of this file
  const char* box = "";                 ///< of the files that hold most, a part is built
};

const Input kInputs[] = {
    {"gfs_2p5_20110110_f120.grib2", "levels", 21, 1, "longlat", {"Xu & Randall"}, {"one_condensate"}},
    {"wrfout_katrina_mercator_20050828.nc", "levels", 14, 4, "merc", {}, {"liquid_holds_ice", "sphere"}},
    {"era5_cirrus_16x8x4x13.nc", "levels", 4, 13, "longlat", {}, {"several_times", "dimension_order"}},
    {"gfs_icmr_17x17x3x7.nc", "levels", 3, 7, "longlat", {}, {}},
    {"eta_g211_lambert_20041208_f24.grib2", "levels", 19, 1, "lcc", {"RH"}, {"negative_cloud_height"}, "-100,30,-80,45"},
    {"ruc13_g212_2005080700_f00.grb", "levels", 39, 1, "lcc", {"RH", "hypsometric"}, {}, "-100,30,-85,42"},
    {"wafs_thinned_reduced_ll_20070110.grib2", "levels", 11, 1, "longlat", {"RH"}, {}, "-100,0,-40,50"},
    {"ifs_oper_20240101_10msgs.grib2", "levels", 3, 1, "longlat", {"RH"}, {}, "-10,40,10,55"},
    {"icon-eu_CLCT_MOD_20220427_f047.grib2", "layers", 0, 1, "longlat", {}, {}, "0,45,15,55"},
    {"cfs_flux_regular_gg_20060331.grb", "layers", 0, 1, "longlat", {}, {"averaged_cover"}, "-60,10,30,60"},
    {"icon_ny-alesund_column_20210104.nc", "levels", 90, 25, "", {}, {}},
    {"metar_collective.txt", "layers", 0, 0, "longlat", {}, {"unknown_station"}},
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "-" : text;
}

std::vector<std::string> idsOf(const json& inspected) {
  std::vector<std::string> ids;
  for (const json& warning : inspected.at("warnings")) ids.push_back(warning.at("id"));
  return ids;
}

std::string generaOf(const json& report) {
  std::vector<std::string> genera;
  for (const auto& [genus, count] : report.at("genera").items()) genera.push_back(genus + ":" + count.dump());
  return joined(genera);
}

void printRow(const Input& input, const json& inspected, const json& report) {
  const json& grid = inspected.at("grid");
  std::printf("| %s | %s, %s | %zu %s | %zu | %s %sx%s | %s layers | %s | %s |\n", input.file,
              inspected.at("format").get<std::string>().c_str(),
              inspected.at("model").get<std::string>().c_str(), inspected.at("levels").at("values").size(),
              inspected.at("levels").at("kind").get<std::string>().c_str(),
              inspected.at("valid_times").size(), grid.at("kind").get<std::string>().c_str(),
              grid.at("columns").dump().c_str(), grid.at("rows").dump().c_str(),
              report.at("counts").at("layers").dump().c_str(), generaOf(report).c_str(),
              joined(idsOf(inspected)).c_str());
}

class EachOfInputs : public ::testing::TestWithParam<Input> {};

TEST_P(EachOfInputs, IsInspectedAndBuilt) {
  if (!sharedFile("README.md")) GTEST_SKIP() << "no ../shared/data";
  const Input& input = GetParam();
  const auto file = sharedFile(input.file);
  ASSERT_TRUE(file) << "is not in ../shared/data";
  const Ran inspection = runCloudgen({"inspect", *file, "--json"});
  ASSERT_EQ(inspection.exitCode, 0) << inspection.err;
  const json inspected = json::parse(inspection.out);
  expectFitsSchema(inspected, "inspect.schema.json");
  EXPECT_EQ(inspected.at("tells"), input.tells);
  EXPECT_EQ(inspected.at("levels").at("values").size(), input.levels);
  if (input.times > 0) {
    EXPECT_EQ(inspected.at("valid_times").size(), input.times);
  }
  EXPECT_NE(inspected.at("grid").at("crs").get<std::string>().find(input.gridCrs), std::string::npos);
  const auto ids = idsOf(inspected);
  for (const char* id : input.warningIds) EXPECT_GE(std::count(ids.begin(), ids.end(), id), 1) << id;

  Scratch folder;
  const std::string out = folder.path() / "scene";
  std::vector<std::string> words{"build", *file, "-o", out, "--json", "--max-puffs", "2000", "--formats", "splats"};
  if (*input.box) words.insert(words.end(), {"--bbox", input.box});
  const Ran built = runCloudgen(words);
  ASSERT_EQ(built.exitCode, 0) << built.err;
  const json report = json::parse(built.out);
  expectFitsSchema(report, "report.schema.json");
  EXPECT_GT(report.at("counts").at("layers").get<int>(), 0);
  EXPECT_GT(report.at("counts").at("clouds").get<int>(), 0);
  const std::string derived = report.at("derived").dump();
  for (const char* word : input.derived)
    EXPECT_NE(derived.find(word), std::string::npos) << word << " in " << derived;
  printRow(input, inspected, report);
}
INSTANTIATE_TEST_SUITE_P(All, EachOfInputs, ::testing::ValuesIn(kInputs), [](const auto& input) {
  std::string name = input.param.file;
  std::replace_if(name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

/// Files of a time series in one run: each hour is there.
TEST(Inputs, AnHourAFileIsOneInput) {
  std::vector<std::string> words{"inspect", "--json"};
  for (const char* name :
       {"ruc13_g212_2005080700_f00.grb", "ruc13_g212_2005080700_f12.grb", "ruc13_g212_2005080700_f24.grb"}) {
    const auto file = sharedFile(name);
    if (!file) GTEST_SKIP() << "no " << name;
    words.push_back(*file);
  }
  const Ran first = runCloudgen(words);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(json::parse(first.out).at("valid_times"),
            (json{"2005-08-07T00:00:00Z", "2005-08-07T12:00:00Z", "2005-08-08T00:00:00Z"}));
  words.insert(words.end(), {"--time", "2005-08-07T12:00Z"});
  const Ran second = runCloudgen(words);
  ASSERT_EQ(second.exitCode, 0) << second.err;
  EXPECT_EQ(json::parse(second.out).at("valid_time"), "2005-08-07T12:00:00Z");
}

std::string example(const std::string& name) {
  return std::string(CLOUDGEN_SOURCE_DIR) + "/examples/inputs/" + name;
}

/// A forecaster's pair: the genera are those of the typing, the amount is the model's.
TEST(Inputs, TypingDecidesTheGenera) {
  const auto gfs = gfsForecast();
  if (!gfs) GTEST_SKIP() << "no GFS forecast";
  Scratch folder;
  const Ran ran =
      runCloudgen({"build", *gfs, "--typing", example("typing.sky.json"), "--bbox", "-92,30,-84,37", "-o",
                   folder.path() / "scene", "--json", "--formats", "splats", "--max-puffs", "20000"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json report = json::parse(ran.out);
  expectFitsSchema(report, "report.schema.json");
  const json& typing = report.at("typing");
  EXPECT_GT(typing.at("typed_columns").get<int>(), 200);
  EXPECT_GE(typing.at("agreement").get<double>(), 0.99);
  EXPECT_NEAR(typing.at("cover_kept").get<double>(), 1, 0.02);
  for (const auto& [genus, count] : report.at("genera").items())
    EXPECT_TRUE(genus == "Sc" || genus == "As" || genus == "Ci") << genus;
}

/// Each time of a sky that moves takes the genera of its own hour.
TEST(Inputs, TypingOfAllTimes) {
  const Scratch folder;
  const std::string hours = example("helsinki.weather.json"), out = folder.path() / "scene";
  const Ran ran = runCloudgen({"build", hours, "--typing", hours, "--time", "all", "--max-puffs", "2000", "--formats", "pack", "-o", out, "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json report = json::parse(ran.out);
  EXPECT_GT(report.at("valid_times").size(), 1u);
  EXPECT_EQ(report.at("motion").at("hours").size() + 1, report.at("valid_times").size());
  EXPECT_GE(report.at("typing").at("agreement").get<double>(), 0.99);
}

/// Of a typing of several hours the one nearest to the model is taken.
TEST(Inputs, TheNearestHourOfATypingIsTaken) {
  Scratch folder;
  const std::string model = folder.write("model.sky.json", R"({
    "cloudgen_sky": 1, "valid_time": "2026-06-21T13:00:00Z", "bbox": [24.8, 60.1, 25.1, 60.25],
    "layers": [{"genus": "Cu", "cover": 0.4, "base_m": 1200, "top_m": 2400, "optical_depth": 10}]})");
  const Ran ran =
      runCloudgen({"build", model, "--typing", example("helsinki.weather.json"), "-o",
                   folder.path() / "scene", "--json", "--formats", "splats", "--max-puffs", "5000"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json typing = json::parse(ran.out).at("typing");
  EXPECT_EQ(typing.at("valid_time"), "2026-06-21T12:00:00Z");
  EXPECT_EQ(typing.at("minutes_after_model"), -60);
}

TEST(Inputs, WeatherCodesOfTheExample) {
  Scratch folder;
  const Ran ran = runCloudgen({"build", example("helsinki.weather.json"), "--time", "2026-06-21T12:00Z", "-o",
                               folder.path() / "scene", "--json", "--formats", "splats"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json report = json::parse(ran.out);
  EXPECT_EQ(report.at("source").at("format"), "weather codes (JSON)");
  EXPECT_GE(report.at("counts").at("clouds").get<int>(), 75) << "many clouds: the thesis's count";
}

TEST(Inputs, ReportsOfTheExample) {
  Scratch folder;
  const Ran ran =
      runCloudgen({"build", example("channel-2026-06-21.metar.txt"), "-o", folder.path() / "scene", "--json",
                   "--formats", "splats", "--max-puffs", "20000"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json genera = json::parse(ran.out).at("genera");
  EXPECT_TRUE(genera.contains("Cb")) << genera;
  EXPECT_TRUE(genera.contains("Cu")) << genera;
}

TEST(Inputs, ShapesOfTheExamples) {
  const std::filesystem::path shapes = std::filesystem::path(CLOUDGEN_SOURCE_DIR) / "examples" / "shapes";
  for (const auto& [name, kind] : {std::pair{"hare.ply", "mesh"}, std::pair{"ring.obj", "mesh"},
                                   std::pair{"congestus.lsystem.json", "lsystem"}}) {
    SCOPED_TRACE(name);
    Scratch folder;
    const std::string sky = std::string(CLOUDGEN_SOURCE_DIR) + "/examples/gallery/cumulus.sky.json";
    const Ran ran = runCloudgen({"build", sky, "--shape", shapes / name, "-o", folder.path() / "scene",
                                 "--json", "--formats", "splats", "--max-puffs", "20000", "--verify"});
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json report = json::parse(ran.out);
    expectFitsSchema(report, "report.schema.json");
    EXPECT_EQ(report.at("shapes").at(0).at("file"), name);
    EXPECT_EQ(report.at("shapes").at(0).at("kind"), kind);
    EXPECT_GT(report.at("shapes").at(0).at("clouds").get<int>(), 2);
    EXPECT_TRUE(report.at("verify").at("passed").get<bool>()) << report.at("verify").at("broken");
  }
}

/// A recipe gives a volume to one genus; how near the puffs are to it is said.
TEST(Inputs, ARecipeNamesAShape) {
  Scratch folder;
  const std::filesystem::path source(CLOUDGEN_SOURCE_DIR), types = folder.path() / "types";
  std::filesystem::copy(source / "templates" / "types", types);
  std::filesystem::copy(source / "tests" / "fuzz" / "seeds" / "volume" / "les.nc", types / "box.nc");
  std::ofstream(types / "cumulus.json") << R"({
    "genus": "Cu", "form": "file", "shape": {"file": "box.nc", "variable": "ql", "flat_base": true},
    "width_m": [500, 4000], "thickness_m": [250, 5000], "optical_depth": 30, "sheet": false})";
  const std::vector<std::string> build{"build",   folder.write("a.sky.json", smallSky()),
                                       "--types", types,
                                       "-o",      folder.path() / "scene",
                                       "--json",  "--formats",
                                       "splats",  "--max-puffs",
                                       "5000",    "--overwrite"};
  const Ran ran = runCloudgen(build);
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json report = json::parse(ran.out);
  expectFitsSchema(report, "report.schema.json");
  const json shape = report.at("shapes").at(0);
  EXPECT_EQ(shape.at("kind"), "volume");
  EXPECT_LT(shape.at("optical_depth_error").at("above").get<double>(), 0.5);
  std::filesystem::remove(types / "box.nc");
  const Ran without = runCloudgen(build);
  EXPECT_EQ(without.exitCode, 1);
  EXPECT_NE(without.err.find("box.nc"), std::string::npos) << without.err;
}

TEST(Inputs, TypingFarAwayInTimeIsRefused) {
  Scratch folder;
  const std::string model = folder.write("model.sky.json", smallSky());
  const std::string typing = folder.write("typing.sky.json", R"({
    "cloudgen_sky": 1, "valid_time": "2001-01-01T00:00:00Z", "bbox": [-123, 36, -121, 38],
    "layers": [{"genus": "Cu", "cover": 0.4, "base_m": 1200, "top_m": 2400, "optical_depth": 10}]})");
  const Ran ran = runCloudgen({"build", model, "--typing", typing, "-o", folder.path() / "scene"});
  EXPECT_EQ(ran.exitCode, 1);
  EXPECT_NE(ran.err.find("--typing-window"), std::string::npos) << ran.err;
}

}  // namespace
