// SPDX-License-Identifier: Apache-2.0
// What the program does when all is well, as people and other programs see it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using Words = std::vector<std::string>;

class Run : public ::testing::Test {
 protected:
  Ran build(const Words& more, const std::string& name = "scene") const {
    Words words{"build", sky, "-o", folder.path() / name, "--max-puffs", "2000"};
    words.insert(words.end(), more.begin(), more.end());
    return runCloudgen(words);
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder.path() / name); }

  Scratch folder;
  std::string sky = folder.write("small.sky.json", smallSky());
  std::string out = folder.path() / "scene";
};

TEST_F(Run, HelpIsNoFailure) {
  for (const Words& words : {Words{"-h"}, Words{"--help"}, Words{"build", "-h"}, Words{"build", "--help"},
                             Words{"validate", "--help"}}) {
    const Ran ran = runCloudgen(words);
    EXPECT_EQ(ran.exitCode, 0) << words.front() << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_GT(ran.out.size(), 100u);
  }
  EXPECT_NE(runCloudgen({"build", "-h"}).out.find("--bbox"), std::string::npos);
}

TEST_F(Run, NothingAskedIsAnsweredByAShortUsage) {
  const Ran ran = runCloudgen({});
  EXPECT_EQ(ran.exitCode, 2);
  const std::string said = ran.out + ran.err;
  EXPECT_NE(said.find("usage: cloudgen"), std::string::npos);
  EXPECT_LT(std::count(said.begin(), said.end(), '\n'), 25);
}

TEST_F(Run, MachinesGetJsonAndNothingElse) {
  for (const Words& words : {Words{"--version", "--json"}, Words{"types", "--json"},
                             Words{"formats", "--json"}, Words{"inspect", sky, "--json"}}) {
    const Ran ran = runCloudgen(words);
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    EXPECT_TRUE(nlohmann::json::accept(ran.out)) << words.front() << ": " << ran.out;
  }
  const auto version = nlohmann::json::parse(runCloudgen({"--version", "--json"}).out);
  EXPECT_TRUE(version.contains("version"));
  EXPECT_FALSE(version.at("formats").empty());
}

TEST_F(Run, WritesWhatWasAskedForAndReportsIt) {
  const Ran ran = build({"--json", "--formats", "x3d,splats"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  EXPECT_TRUE(has("scene/scene.x3d"));
  EXPECT_TRUE(has("scene/scene.splats.glb"));
  EXPECT_TRUE(has("scene/report.json"));
  EXPECT_FALSE(has("scene/scene.wrl"));
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_GT(report.at("counts").at("clouds").get<int>(), 0);
  EXPECT_LE(report.at("counts").at("puffs").get<int>(), 2000);
  EXPECT_EQ(report.at("valid_times").at(0), "2026-06-21T20:00:00Z");
  EXPECT_EQ(namesIn(folder.path()).front(), "scene") << "something was left beside the scene";
}

TEST_F(Run, QuietIsQuiet) {
  const Ran ran = build({"--quiet", "--formats", "x3d"});
  EXPECT_EQ(ran.exitCode, 0);
  EXPECT_EQ(ran.out + ran.err, "");
}

TEST_F(Run, ItsOwnScenesAreValid) {
  ASSERT_EQ(build({}).exitCode, 0);
  Words words{"validate"};
  for (const std::string& name : namesIn(out))
    if (name.starts_with("scene.")) words.push_back(out + "/" + name);
  ASSERT_GE(words.size(), 5u);
  const Ran ran = runCloudgen(words);
  EXPECT_EQ(ran.exitCode, 0) << ran.out << ran.err;
}

TEST_F(Run, AnInvalidSceneEndsWithFour) {
  const Ran ran = runCloudgen(
      {"validate", "--json",
       folder.write("bad.x3d", "<X3D profile='Immersive' version='4.0'><Scene><Clowd/></Scene></X3D>")});
  EXPECT_EQ(ran.exitCode, 4) << ran.err;
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_FALSE(report.at("valid").get<bool>());
  EXPECT_FALSE(report.at("files").at(0).at("findings").empty());
}

TEST_F(Run, ReplacesItsOwnFolderOnlyWhenAsked) {
  ASSERT_EQ(build({"--formats", "x3d"}).exitCode, 0);
  const auto before = contentOf(out);
  const Ran refused = build({"--formats", "splats"});
  EXPECT_EQ(refused.exitCode, 4);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(differences(contentOf(out), before), Words{});
  ASSERT_EQ(build({"--formats", "splats", "--overwrite"}).exitCode, 0);
  EXPECT_TRUE(has("scene/scene.splats.glb"));
  EXPECT_FALSE(has("scene/scene.x3d")) << "the old scene is still there";
}

TEST_F(Run, AFailedReplacementLeavesTheOldScene) {
  ASSERT_EQ(build({"--formats", "x3d"}).exitCode, 0);
  const auto before = contentOf(out);
  EXPECT_NE(build({"--bbox", "10,10,11,11", "--overwrite"}).exitCode, 0);
  EXPECT_EQ(differences(contentOf(out), before), Words{});
}

TEST_F(Run, OptionsComeFromAFile) {
  const std::string config = folder.write("options.toml", "formats = \"splats\"\nseed = 7\n");
  const Ran ran = build({"--json", "--config", config});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out).at("seed"), 7);
  EXPECT_TRUE(has("scene/scene.splats.glb"));
  EXPECT_FALSE(has("scene/scene.x3d"));
}

TEST_F(Run, ABoxMayCrossTheAntimeridian) {
  const auto forecast = gfsForecast();
  if (!forecast) GTEST_SKIP() << "the GFS forecast of python-grib-doc is not there";
  const Ran ran = runCloudgen({"build", *forecast, "--bbox", "170,-20,-170,0", "-o", out, "--formats",
                               "splats", "--max-puffs", "3000", "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_GT(report.at("counts").at("clouds").get<int>(), 0);
  EXPECT_EQ(report.at("bbox"), nlohmann::json({170, -20, -170, 0}));
}

TEST_F(Run, AnInterruptedRunLeavesNothing) {
  const auto forecast = gfsForecast();
  if (!forecast) GTEST_SKIP() << "the GFS forecast of python-grib-doc is not there";
  const auto before = namesIn(folder.path());
  RunOptions options;
  // It has begun once its hidden folder is there.
  options.interruptWhen = [&](int) { return namesIn(folder.path()).size() > before.size(); };
  const Ran ran = runCloudgen({"build", *forecast, "--bbox", "-100,25,-60,50", "-o", out}, options);
  EXPECT_EQ(ran.exitCode, 130) << ran.err;
  EXPECT_NE(ran.err.find("interrupted"), std::string::npos) << ran.err;
  EXPECT_EQ(namesIn(folder.path()), before);
}

TEST_F(Run, PicturesOfAScene) {
  ASSERT_EQ(build({"--formats", "splats"}).exitCode, 0);
  for (const char* view : {"top", "ground", "horizon", "-122.02,36.7,1500:-122.02,36.78,1400"}) {
    const Ran ran =
        runCloudgen({"preview", out, "-o", folder.path() / "a.png", "--size", "160x90", "--view", view});
    EXPECT_EQ(ran.exitCode, 0) << view << ran.err;
    EXPECT_EQ(contentOf(folder.path())["a.png"].substr(1, 3), "PNG");
  }
  EXPECT_EQ(runCloudgen({"preview", out, "-o", folder.path() / "b.png", "--view", "sideways"}).exitCode, 2);
  EXPECT_FALSE(has("b.png"));
}

}  // namespace
