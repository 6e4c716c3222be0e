// SPDX-License-Identifier: Apache-2.0
// Clouds traced back to the model cell and the rule that made them, and lists that somebody damaged.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cli/fits_schema.hpp"
#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using Words = std::vector<std::string>;
using nlohmann::json;

/// The rows of a list as name to text.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& file) {
  std::vector<std::map<std::string, std::string>> rows;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const Words names = cloudgen::base::split(line, ',');
  while (std::getline(stream, line)) {
    const Words fields = cloudgen::base::split(line, ',');
    EXPECT_EQ(fields.size(), names.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) row[names[i]] = fields[i];
  }
  return rows;
}

/// The ids of the clouds in the X3D files of a folder.
std::set<std::string> idsNamedIn(const std::string& folder) {
  constexpr std::string_view kBefore = "\"id genus rule\"";
  std::set<std::string> ids;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".x3d") continue;
    const std::string x3d = cloudgen::base::readFile(entry.path());
    for (std::size_t at = x3d.find(kBefore); at != x3d.npos; at = x3d.find(kBefore, at + 1)) {
      const std::size_t first = x3d.find_first_of("0123456789", at),
                        last = x3d.find_first_not_of("0123456789", first);
      ids.insert(x3d.substr(first, last - first));
    }
  }
  return ids;
}

class Explain : public ::testing::Test {
 protected:
  void build(const Words& more) const {
    Words words{"--formats", "x3d", "--max-puffs", "6000"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = buildOnce(words, scene);
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
  }
  void buildSmallSky() const { build({smallSkyFile()}); }
  std::string firstId() const { return rowsOf(scene + "/clouds.csv").at(0).at("id"); }
  json explained(const std::string& id) const {
    const Ran ran = runCloudgen({"explain", scene, id, "--json"});
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    json result = json::parse(ran.out, nullptr, false);
    expectFitsSchema(result, "explain.schema.json");
    return result;
  }
  void refuses(const Words& arguments, int exitCode, const std::string& part) const {
    const Ran ran = runCloudgen(arguments);
    EXPECT_EQ(ran.exitCode, exitCode) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_LE(std::count(ran.err.begin(), ran.err.end(), '\n'), 2) << ran.err;
    EXPECT_NE(ran.err.find(part), std::string::npos) << "says nothing of \"" << part << "\": " << ran.err;
  }
  /// Refuses the first cloud after a list was changed.
  void refusesAfter(const std::string& name, const std::function<void(std::string&)>& edit,
                    const std::string& part) const {
    const std::string id = firstId(), file = scene + "/" + name, before = cloudgen::base::readFile(file);
    std::string bytes = before;
    edit(bytes);
    std::ofstream(file, std::ios::binary) << bytes;
    SCOPED_TRACE(part);
    refuses({"explain", scene, id}, 1, part);
    std::ofstream(file, std::ios::binary) << before;
  }

  Scratch folder;
  std::string scene = folder.path() / "scene";
};

/// Replaces a field of the second line.
std::function<void(std::string&)> withField(std::size_t field, const std::string& text) {
  return [field, text](std::string& bytes) {
    std::size_t at = bytes.find('\n') + 1;
    for (std::size_t i = 0; i < field; ++i) at = bytes.find(',', at) + 1;
    bytes.replace(at, bytes.find_first_of(",\n", at) - at, text);
  };
}

TEST_F(Explain, WhatTheSourceStatesIsSaidToBeStated) {
  buildSmallSky();
  const json result = explained(firstId());
  EXPECT_EQ(result.at("cloud").at("genus"), "Cu");
  EXPECT_EQ(result.at("cloud").at("id"), firstId());
  EXPECT_EQ(result.at("rule").at("id"), "stated");
  EXPECT_FALSE(result.at("rule").at("derived").get<bool>());
  EXPECT_TRUE(result.at("layer").at("top_temperature_k").is_null());
  const Ran ran = runCloudgen({"explain", scene, firstId()});
  EXPECT_NE(ran.out.find("the source states the genus"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(" ft)"), std::string::npos) << ran.out;
}

TEST_F(Explain, EveryDerivedTypeFollowsFromItsValues) {
  const auto forecast = sharedFile("gfs_2p5_20110110_f120.grib2");
  if (!forecast) GTEST_SKIP() << "../shared/data is not there";
  build({*forecast, "--bbox", "-90,25,-70,45"});
  std::map<std::string, std::string> idOfRule;
  std::set<std::string> ids;
  for (const auto& row : rowsOf(scene + "/clouds.csv")) {
    const std::string &rule = row.at("rule"), &id = row.at("id");
    idOfRule.try_emplace(rule, id);
    EXPECT_TRUE(ids.insert(id).second) << id << " stands twice";
  }
  EXPECT_GE(idOfRule.size(), 6u);
  EXPECT_EQ(idsNamedIn(scene), ids);
  for (const auto& [rule, id] : idOfRule) {
    SCOPED_TRACE(rule);
    const json result = explained(id);
    EXPECT_EQ(result.at("rule").at("id"), rule);
    EXPECT_EQ(result.at("rule").at("would_decide_now"), rule);
    EXPECT_FALSE(result.at("rule").at("demands").empty());
    for (const json& demand : result.at("rule").at("demands")) EXPECT_TRUE(demand.at("met").get<bool>());
    for (const json& tried : result.at("rule").at("tried_before"))
      EXPECT_FALSE(tried.at("unmet").at("met").get<bool>()) << tried.at("id");
    const Ran ran = runCloudgen({"explain", scene, id});
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    EXPECT_NE(ran.out.find("rule " + rule + "\n"), std::string::npos) << ran.out;
  }
}

TEST_F(Explain, ATypingIsNamedAsTheReason) {
  build({smallSkyFile(), "--typing", smallSkyFile()});
  EXPECT_TRUE(explained(firstId()).at("rule").at("id").get<std::string>().starts_with("typing"));
}

TEST_F(Explain, AChangedLayerIsNoticed) {
  const auto forecast = sharedFile("gfs_2p5_20110110_f120.grib2");
  if (!forecast) GTEST_SKIP() << "../shared/data is not there";
  build({*forecast, "--bbox", "-90,25,-70,45"});
  const std::string file = scene + "/layers.csv";
  std::string bytes = cloudgen::base::readFile(file);
  const std::string genuine = explained(firstId()).at("rule").at("id");
  withField(3, genuine == "high.default" ? "fog.signature" : "high.default")(bytes);
  std::ofstream(file, std::ios::binary) << bytes;
  const json rule = explained(firstId()).at("rule");
  EXPECT_EQ(rule.at("would_decide_now"), genuine);
  EXPECT_NE(rule.at("id"), genuine);
}

TEST_F(Explain, CloudsAndFoldersThatAreNotThere) {
  buildSmallSky();
  refuses({"explain", scene, "123456789012345"}, 1, "has no cloud 123456789012345");
  refuses({"explain", scene, "99999999999999999999"}, 2, "is not the id of a cloud");
  refuses({"explain", scene, "-1"}, 2, "");
  refuses({"explain", scene, "cumulus"}, 2, "clouds.csv");
  refuses({"explain", scene}, 2, "CLOUD_ID");
  refuses({"explain", folder.path(), "7"}, 1, "clouds.csv");
  refuses({"explain", folder.path() / "nothing", "7"}, 1, "clouds.csv");
}

TEST_F(Explain, DamagedListsAreRefused) {
  buildSmallSky();
  refusesAfter(
      "clouds.csv", [](std::string& bytes) { bytes.clear(); }, "does not begin");
  refusesAfter(
      "clouds.csv", [](std::string& bytes) { bytes = "name,age\n1,2\n"; }, "does not begin");
  refusesAfter("clouds.csv", withField(0, "x"), "line 2");
  refusesAfter("clouds.csv", withField(1, "Zz"), "genus");
  refusesAfter("clouds.csv", withField(2, "no.such.rule"), "rule");
  refusesAfter("clouds.csv", withField(3, "-4"), "cell");
  refusesAfter("clouds.csv", withField(4, "70000"), "layer");
  refusesAfter("clouds.csv", withField(6, "91"), "latitude");
  refusesAfter("clouds.csv", withField(7, "nan"), "base_m");
  refusesAfter("clouds.csv", withField(7, ""), "base_m");
  refusesAfter("clouds.csv", withField(9, "1,2"), "fields");
  refusesAfter("clouds.csv", withField(5, std::string(100'000, '1')), "too long");
  refusesAfter(
      "clouds.csv", [](std::string& bytes) { bytes.resize(bytes.find('\n') + 20); }, "fields");
  refusesAfter(
      "layers.csv", [](std::string& bytes) { bytes.resize(bytes.find('\n') + 1); }, "has no layer");
  refusesAfter("layers.csv", withField(10, "1e30"), "cover");
  refusesAfter("layers.csv", withField(8, "1e999"), "base_m");
  std::filesystem::remove(scene + "/layers.csv");
  refuses({"explain", scene, firstId()}, 1, "layers.csv");
}

TEST_F(Explain, NoDamageBringsItDown) {
  buildSmallSky();
  const std::string id = firstId();
  for (const char* name : {"/clouds.csv", "/layers.csv"}) {
    const std::string whole = cloudgen::base::readFile(scene + name);
    for (std::size_t i = 0; i < 14; ++i) {
      std::string bytes = whole;
      bytes[(i * 79) % std::min<std::size_t>(bytes.size(), 800)] = "\0\n,\xff-9e"[i % 7];
      std::ofstream(scene + name, std::ios::binary) << bytes;
      const int exitCode = runCloudgen({"explain", scene, id}).exitCode;
      EXPECT_TRUE(exitCode == 0 || exitCode == 1) << name << ' ' << i << ": " << exitCode;
    }
    std::ofstream(scene + name, std::ios::binary) << whole;
  }
}

}  // namespace
