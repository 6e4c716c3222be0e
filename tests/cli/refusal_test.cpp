// SPDX-License-Identifier: Apache-2.0
// What the program says and leaves when it cannot do what it is asked: one message, the right exit code,
// nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/file.hpp"
#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using Words = std::vector<std::string>;

constexpr int kInput = 1, kUsage = 2, kNotBuilt = 3, kOutput = 4;

class Refusal : public ::testing::Test {
 protected:
  /// Runs it and expects this exit code, one message of at most two lines that holds `part`, nothing on
  /// stdout, nothing written.
  void refuses(const Words& arguments, int exitCode, const std::string& part) {
    std::string line;
    for (const std::string& word : arguments) line += " " + word;
    SCOPED_TRACE("cloudgen" + line);
    const auto before = namesIn(folder.path());
    const Ran ran = runCloudgen(arguments);
    EXPECT_EQ(ran.exitCode, exitCode) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(ran.err.starts_with("cloudgen")) << ran.err;
    EXPECT_LE(std::count(ran.err.begin(), ran.err.end(), '\n'), 2) << ran.err;
    EXPECT_EQ(ran.err.find("cloudgen: ", 1), std::string::npos) << "two messages: " << ran.err;
    EXPECT_NE(ran.err.find(part), std::string::npos) << "says nothing of \"" << part << "\": " << ran.err;
    EXPECT_EQ(namesIn(folder.path()), before);
  }

  /// `build` of the small sky with further options.
  Words buildWith(const Words& more) const {
    Words words{"build", sky, "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Scratch folder;
  std::string sky = folder.write("small.sky.json", smallSky());
  std::string out = folder.path() / "scene";
};

TEST_F(Refusal, InputThatIsNotThere) {
  const std::string missing = folder.path() / "missing.grib2";
  refuses({"build", missing, "-o", out}, kInput, missing);
  refuses({"inspect", missing}, kInput, missing);
  std::filesystem::create_directory(folder.path() / "hollow");
  refuses({"build", folder.path() / "hollow", "-o", out}, kInput, "hollow");
}

TEST_F(Refusal, InputThatIsNoModelOutput) {
  refuses({"build", folder.write("empty.grib2", ""), "-o", out}, kInput, "empty.grib2");
  refuses({"build", folder.write("words.grib2", "these are words, no forecast\n"), "-o", out}, kInput,
          "words.grib2");
  refuses({"build", folder.write("noise.bin", std::string(5000, '\xa7')), "-o", out}, kInput, "noise.bin");
  refuses({"build", folder.write("broken.sky.json", "{\"cloudgen_sky\": 1,"), "-o", out}, kInput,
          "broken.sky.json");
  refuses({"build", folder.write("GRIB.grib2", "GRIB"), "-o", out}, kInput, "GRIB.grib2");
}

TEST_F(Refusal, ForecastThatWasCutOff) {
  const auto forecast = gfsForecast();
  if (!forecast) GTEST_SKIP() << "the GFS forecast of python-grib-doc is not there";
  const std::string whole = cloudgen::base::readFile(*forecast);
  for (const std::size_t length : {std::size_t{100}, std::size_t{20'000}})
    refuses({"build", folder.write("cut.grib2", whole.substr(0, length)), "-o", out}, kInput, "cut.grib2");
}

TEST_F(Refusal, InputThatSaysNothingOfClouds) {
  const auto file = sharedFile("README.md");
  if (!file) GTEST_SKIP() << "../shared/data is not there";
  refuses({"build", *file, "-o", out}, kInput, "of no format that cloudgen reads");
}

TEST_F(Refusal, BoxOutsideOfTheData) { refuses(buildWith({"--bbox", "10,10,11,11"}), kInput, "10"); }

TEST_F(Refusal, OptionsThatMakeNoSense) {
  refuses(buildWith({"--bbox", "here"}), kUsage, "--bbox here");
  refuses(buildWith({"--bbox", "1,2,3"}), kUsage, "four numbers");
  refuses(buildWith({"--bbox", "1,2,3,nan"}), kUsage, "four numbers");
  refuses(buildWith({"--bbox", "-122,37,-121,36"}), kUsage, "south");
  refuses(buildWith({"--bbox", "-122,-91,-121,36"}), kUsage, "-90..90");
  refuses(buildWith({"--sun", "noon"}), kUsage, "--sun noon");
  refuses(buildWith({"--sun", "180,95"}), kUsage, "--sun 180,95");
  refuses(buildWith({"--time", "tomorrow"}), kUsage, "--time tomorrow");
  refuses(buildWith({"--max-puffs", "12"}), kUsage, "--max-puffs");
  refuses(buildWith({"--max-puffs", "many"}), kUsage, "--max-puffs");
  refuses(buildWith({"--threads", "-3"}), kUsage, "--threads");
  refuses(buildWith({"--seed", "-1"}), kUsage, "--seed");
  refuses(buildWith({"--frame", "flat"}), kUsage, "--frame flat");
  refuses({"build", sky}, kUsage, "--output");
  refuses({"build", "-o", out}, kUsage, "INPUT");
  refuses({"preview", folder.path(), "-o", out, "--size", "big"}, kUsage, "--size big");
}

TEST_F(Refusal, ShapesThatAreNone) {
  refuses(buildWith({"--shape", folder.path() / "none.obj"}), kInput, "none.obj");
  refuses(buildWith({"--shape", folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}), kInput,
          "flat");
  refuses(buildWith({"--shape", folder.write("bad.off", "OFF\n1 1 0\n0 0\n")}), kInput, "bad.off, line 3");
  refuses(buildWith({"--shape", folder.write("a.lsystem.json", "{}")}), kInput, "a.lsystem.json");
  refuses(buildWith({"--shape", folder.write("cloud.xyz", "")}), kInput, ".obj");
  refuses(buildWith({"--shape", folder.write("cloud.vdb", "words")}), kInput, "is not OpenVDB");
}

TEST_F(Refusal, TimeThatTheDataDoNotHave) {
  refuses(buildWith({"--time", "2020-01-01T00:00Z"}), kInput, "2026-06-21T20:00");
}

TEST_F(Refusal, FlightsThatAreNone) {
  for (const char* flight :
       {"46,7", "46,7,3000", "46,7,3000;91,7,3000", "46,7,high;46,8,3000", "46,7,3000;46,8,3000;"})
    refuses(buildWith({"--fly", flight}), kUsage, "--fly");
}

TEST_F(Refusal, WordsThatItDoesNotKnow) {
  refuses({"biuld", sky, "-o", out}, kUsage, "did you mean build?");
  refuses({"zzzzzz"}, kUsage, "zzzzzz");
  refuses(buildWith({"--overwite"}), kUsage, "did you mean --overwrite?");
  refuses(buildWith({"--formats", "x3dd"}), kUsage, "did you mean x3d?");
  refuses(buildWith({"--formats", "splat"}), kUsage, "did you mean splats?");
}

TEST_F(Refusal, WhatIsNotBuilt) {
  refuses(buildWith({"--formats", "x3d,vdb"}), kNotBuilt, "vdb");
  refuses(buildWith({"--frame", "geo"}), kNotBuilt, "--frame geo");
  refuses(buildWith({"--x3d-profile", "xite"}), kNotBuilt, "--x3d-profile xite");
  refuses(buildWith({"--shard", "1/4"}), kNotBuilt, "--shard");
  refuses({"merge", out, "-o", out}, kNotBuilt, "merge");
}

TEST_F(Refusal, ScenesThatCannotBeVerified) {
  refuses({"verify", out, "--against", sky}, kInput, "report.json");
  refuses({"verify", out}, kUsage, "--against");
  refuses(buildWith({"--verify", "--formats", "vrml"}), kUsage, "--verify");
}

TEST_F(Refusal, PlacesThatCannotBeWritten) {
  refuses({"build", sky, "-o", "/proc/scene"}, kOutput, "/proc");
  refuses({"build", sky, "-o", folder.path() / "no" / "such" / "scene"}, kOutput, "no such folder");
  refuses({"build", sky, "-o", folder.write("file", "mine")}, kOutput, "not a folder");
  refuses({"build", sky, "-o", folder.write("file", "mine"), "--overwrite"}, kOutput, "not a folder");
}

TEST_F(Refusal, FoldersThatAreInUse) {
  std::filesystem::create_directory(out);
  std::ofstream(std::filesystem::path(out) / "letter.txt") << "not ours";
  refuses(buildWith({}), kOutput, "--overwrite");
  refuses(buildWith({"--overwrite"}), kOutput, "report.json");
}

TEST_F(Refusal, FilesThatAreNoScenes) {
  refuses({"preview", folder.path(), "-o", out}, kInput, "scene.splats.glb");
  refuses({"preview", folder.write("words.glb", "these are words"), "-o", out}, kInput, "words.glb");
}

TEST_F(Refusal, ScenesThatAreNotThereDoNotKeepOthersFromBeingChecked) {
  const Ran ran = runCloudgen(
      {"validate", folder.path() / "missing.x3d", folder.write("bad.x3d", "<X3D><Clowd/></X3D>")});
  EXPECT_EQ(ran.exitCode, kInput) << ran.err;
  EXPECT_NE(ran.err.find("missing.x3d"), std::string::npos) << ran.err;
  EXPECT_NE(ran.out.find("Clowd"), std::string::npos) << ran.out;
}

}  // namespace
