// SPDX-License-Identifier: Apache-2.0
// Several times of a forecast as one sky, from the command line.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/fits_schema.hpp"
#include "cli/program.hpp"
#include "support/read_png.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using nlohmann::json;

/// How much the picture of a sky changes from each time to the next, in the mean over its bytes.
std::vector<double> changesOf(const std::string& sky, const std::string& view, const std::vector<std::string>& times,
                              const std::string& picture) {
  std::vector<double> changes;
  std::vector<unsigned char> before;
  for (const std::string& time : times) {
    EXPECT_EQ(runCloudgen({"preview", sky, "-o", picture, "--time", time, "--size", "160x90", "--draft", "--view=" + view}).exitCode, 0);
    const auto bytes = readPng(picture).bytes;
    double sum = 0;
    for (std::size_t i = 0; i < before.size(); ++i) sum += std::abs(bytes[i] - before[i]);
    if (!before.empty()) changes.push_back(sum / static_cast<double>(bytes.size()));
    before = bytes;
  }
  return changes;
}

/// Cirrus over thirteen hours.
class Moving : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(forecast)) GTEST_SKIP() << "no " << forecast;
  }
  Ran build(const std::vector<std::string>& more) const {
    // With fewer the drift of an hour is that of a few pairs.
    std::vector<std::string> words{forecast, "--max-puffs", "12000", "--formats", "pack"};
    words.insert(words.end(), more.begin(), more.end());
    return buildOnce(words, out);
  }

  const std::string forecast = std::string(CLOUDGEN_SHARED_DIR) + "/data/era5_cirrus_16x8x4x13.nc";
  Scratch folder;
  std::string out = folder.path() / "moving";
};

TEST_F(Moving, AllTimesAreOneSky) {
  const Ran built = build({"--time", "all", "--json"});
  ASSERT_EQ(built.exitCode, 0) << built.err;
  const json report = json::parse(built.out);
  expectFitsSchema(report, "report.schema.json");
  EXPECT_EQ(report.at("valid_times").size(), 13u);
  const json& motion = report.at("motion");
  ASSERT_EQ(motion.at("hours").size(), 12u);
  for (const json& hour : motion.at("hours")) {
    EXPECT_GT(hour.at("matched_share").get<double>(), 0.2);
    EXPECT_NEAR(hour.at("drift_over_wind").get<double>(), 1, 0.15);
  }
  EXPECT_EQ(runCloudgen({"validate", out + "/scene.cgpack"}).exitCode, 0);

  const std::string picture = folder.path() / "between.png";
  const std::string first = report.at("valid_times")[0], last = report.at("valid_times")[12];
  EXPECT_EQ(runCloudgen({"preview", out, "-o", picture, "--time", last, "--size", "96x54", "--draft"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::exists(picture));
  const Ran late = runCloudgen({"preview", out, "-o", picture, "--time", "2030-01-01T00:00Z", "--size", "96x54"});
  EXPECT_EQ(late.exitCode, 1);
  EXPECT_NE(late.err.find(first), std::string::npos) << late.err;

  const std::string frames = folder.path() / "frames";
  const Ran film = runCloudgen({"film", out, "-o", frames, "--step", "180", "--size", "64x36", "--draft", "--view", "top"});
  ASSERT_EQ(film.exitCode, 0) << film.err;
  EXPECT_TRUE(std::filesystem::exists(frames + "/00004.png"));
  EXPECT_FALSE(std::filesystem::exists(frames + "/00005.png"));
}

/// In a hurricane the air of the box is another one after three hours: its clouds are followed over stretches of them.
TEST(MovingStorm, CloudsAreFollowedAndCoverGoesEvenly) {
  const std::string storm = std::string(CLOUDGEN_SHARED_DIR) + "/data/wrfout_katrina_mercator_20050828.nc";
  if (!std::filesystem::exists(storm)) GTEST_SKIP() << "no " << storm;
  const Scratch folder;
  const std::string out = folder.path() / "storm";
  const Ran built = runCloudgen({"build", storm, "--time", "all", "--max-puffs", "3000", "--formats", "pack,x3d", "--json", "-o", out});
  ASSERT_EQ(built.exitCode, 0) << built.err;
  // X3D plays fewer clouds: it goes without the skies in between.
  EXPECT_EQ(built.err.find("hold the first time"), std::string::npos) << built.err;
  EXPECT_EQ(runCloudgen({"validate", out + "/scene.x3d"}).exitCode, 0);
  const json report = json::parse(built.out);
  expectFitsSchema(report, "report.schema.json");
  ASSERT_EQ(report.at("motion").at("hours").size(), 3u);
  for (const json& hour : report.at("motion").at("hours")) {
    EXPECT_GT(hour.at("matched_share").get<double>(), 0.4);
    EXPECT_NEAR(hour.at("drift_over_wind").get<double>(), 1, 0.15);
    EXPECT_GT(hour.at("stretches").get<int>(), 1);
  }
  for (const std::string time : {"2005-08-28T12:12Z", "2005-08-28T13:30Z", "2005-08-28T17:00Z", "2005-08-28T19:40Z"}) {
    const Ran verified = runCloudgen({"verify", out, "--against", storm, "--time", time, "--json"});
    EXPECT_EQ(verified.exitCode, 0) << time;
    const json found = json::parse(verified.out);
    expectFitsSchema(found, "verify_between.schema.json");
    EXPECT_NEAR(found.at("cover").at("total").at("bias").get<double>(), 0, 0.03) << time;
  }
  // As a film, it goes on at the times of the forecast as it does between them.
  const auto changes = changesOf(out, "-89.5,22,150000:-89,24.4,0",
                                 {"2005-08-28T17:51Z", "2005-08-28T17:54Z", "2005-08-28T17:57Z", "2005-08-28T18:00Z", "2005-08-28T18:03Z",
                                  "2005-08-28T18:06Z", "2005-08-28T18:09Z"},
                                 folder.path() / "film.png");
  const double between = (changes[0] + changes[1] + changes[4] + changes[5]) / 4;
  EXPECT_GT(between, 0.1) << "it moves";
  EXPECT_LT(changes[2], 2 * between);
  EXPECT_LT(changes[3], 2 * between);
}

/// Between two of its times, too, against the model in between.
TEST_F(Moving, CoverGoesEvenlyFromTimeToTime) {
  ASSERT_EQ(build({"--time", "all"}).exitCode, 0);
  for (const std::string time : {"2019-01-01T00:30Z", "2019-01-01T06:15Z", "2019-01-01T11:45Z"}) {
    const Ran verified = runCloudgen({"verify", out, "--against", forecast, "--time", time, "--json"});
    EXPECT_EQ(verified.exitCode, 0) << time;
    EXPECT_NEAR(json::parse(verified.out).at("cover").at("total").at("bias").get<double>(), 0, 0.03) << time;
  }
  // The picture, too, at noon.
  const auto changes = changesOf(out, "-29,50,60000:-29,54,8000",
                                 {"2019-01-01T10:54Z", "2019-01-01T10:57Z", "2019-01-01T11:00Z", "2019-01-01T11:03Z", "2019-01-01T11:06Z"},
                                 folder.path() / "film.png");
  const double between = (changes[0] + changes[3]) / 2;
  EXPECT_GT(between, 0.01) << "it moves";
  EXPECT_LT(changes[1], 2 * between);
  EXPECT_LT(changes[2], 2 * between);
}

/// At a later time the sky is as near to the model as at the first.
TEST_F(Moving, IsVerifiedAtAnyOfItsTimes) {
  const Ran built = build({"--time", "all", "--json"});
  ASSERT_EQ(built.exitCode, 0) << built.err;
  for (const std::string time : {"2019-01-01T00:00Z", "2019-01-01T06:00Z", "2019-01-01T12:00Z"}) {
    const Ran verified = runCloudgen({"verify", out, "--against", forecast, "--time", time, "--no-maps", "--json"});
    const json found = json::parse(verified.out);
    EXPECT_NEAR(found.at("cover").at("total").at("bias").get<double>(), 0, 0.01) << time;
    EXPECT_NEAR(found.at("optical_depth").at("bias_relative").get<double>(), 0, 0.02) << time;
  }
}

/// The formats that viewers play, too.
TEST_F(Moving, SceneFilesAreVerifiedAtAnyOfItsTimes) {
  const Ran built = runCloudgen({"build", forecast, "--bbox=-32,52,-26,56", "--time", "all", "--sun", "200,40", "--max-puffs", "2000", "--formats",
                                 "x3d,splats,glb,tiles", "-o", out});
  ASSERT_EQ(built.exitCode, 0) << built.err;
  EXPECT_EQ(built.err.find("hold the first time"), std::string::npos) << built.err;
  const auto verified = [&](const std::string& format, const std::string& time) {
    return runCloudgen({"verify", out, "--against", forecast, "--time", time, "--format", format, "--no-maps", "--json"});
  };
  for (const std::string format : {"x3d", "glb", "tiles"})
    for (const std::string time : {"2019-01-01T01:00Z", "2019-01-01T06:00Z", "2019-01-01T12:00Z"}) {
      const json found = json::parse(verified(format, time).out);
      EXPECT_NEAR(found.at("cover").at("total").at("bias").get<double>(), 0, 0.01) << format << " at " << time;
      EXPECT_NEAR(found.at("optical_depth").at("bias_relative").get<double>(), 0, 0.08) << format << " at " << time;
    }
  EXPECT_EQ(verified("splats", "2019-01-01T06:00Z").exitCode, 1);
  EXPECT_EQ(verified("tiles", "2019-01-01T06:30Z").exitCode, 1);
}

TEST_F(Moving, WithoutTimeTheFirstIsBuilt) {
  const Ran built = build({"--json"});
  ASSERT_EQ(built.exitCode, 0) << built.err;
  const json report = json::parse(built.out);
  EXPECT_EQ(report.at("valid_times").size(), 1u);
  EXPECT_FALSE(report.contains("motion"));
  const Ran film = runCloudgen({"film", out, "-o", folder.path() / "frames"});
  EXPECT_EQ(film.exitCode, 1);
  EXPECT_NE(film.err.find("--time all"), std::string::npos) << film.err;
}

}  // namespace
