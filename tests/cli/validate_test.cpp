// SPDX-License-Identifier: Apache-2.0
// The validator as a repository of scenes uses it: many files, patterns, reports for servers, exit codes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "cli/fits_schema.hpp"
#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using nlohmann::json;

const std::string kGood = "<X3D profile=\"Full\" version=\"4.0\"><Scene/></X3D>";
const std::string kBroken =
    "<X3D profile=\"Full\" version=\"4.0\">\n<Scene>\n  <Group USE=\"Nobody\"/>\n</Scene></X3D>";

class Validate : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder.path() / "scenes/deep/er");
    std::filesystem::create_directories(folder.path() / "scenes/.hidden");
    folder.write("scenes/good.x3d", kGood);
    folder.write("scenes/deep/er/broken one.x3d", kBroken);
    folder.write("scenes/deep/sky.wrl", "#VRML V2.0 utf8\nGroup { }\n");
    folder.write("scenes/.hidden/broken.x3d", kBroken);
    folder.write("scenes/notes.txt", "no scene");
  }

  Ran validate(std::vector<std::string> words) const {
    words.insert(words.begin(), "validate");
    return runCloudgen(words);
  }
  std::string at(const std::string& name) const { return folder.path() / name; }

  Scratch folder;
};

TEST_F(Validate, FindsFilesByFolderAndByPattern) {
  const Ran all = validate({at("scenes")});
  EXPECT_EQ(all.exitCode, 4);
  EXPECT_NE(all.out.find("1 of 3 not valid (1 error, 0 warnings)"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("broken one.x3d:3:10: error[use-missing]: there is no node named \"Nobody\" ("),
            std::string::npos)
      << all.out;
  EXPECT_NE(validate({at("scenes/**/*.x3d")}).out.find("1 of 2 not valid"), std::string::npos);
  EXPECT_NE(validate({at("scenes/*.x3d")}).out.find("1 of 1 valid"), std::string::npos);
  EXPECT_NE(validate({at("scenes/d??p/*.[vw]rl"), at("scenes/good.x3d")}).out.find("2 of 2 valid"),
            std::string::npos);
  EXPECT_EQ(validate({"-q", at("scenes/good.x3d")}).out, "");
}

TEST_F(Validate, EndsWithACodeForEachOutcome) {
  EXPECT_EQ(validate({at("scenes/good.x3d")}).exitCode, 0);
  EXPECT_EQ(validate({at("scenes/deep/er/broken one.x3d")}).exitCode, 4);
  for (const std::string missing : {"scenes/absent.x3d", "scenes/*.glb", "scenes/notes.txt"}) {
    const Ran ran = validate({at(missing)});
    EXPECT_EQ(ran.exitCode, 1) << missing;
    EXPECT_NE(ran.err.find(missing), std::string::npos) << ran.err;
  }
  EXPECT_EQ(validate({}).exitCode, 2);
  EXPECT_EQ(validate({at("scenes/good.x3d"), "--sarif", at("scenes/good.x3d")}).exitCode, 2);
  EXPECT_EQ(cloudgen::base::readFile(at("scenes/good.x3d")), kGood);
  EXPECT_EQ(validate({at("scenes/good.x3d"), "--schema", at("absent.xsd")}).exitCode, 1);
  // What cannot be read does not hide what is wrong in the others.
  const Ran both = validate({at("scenes/absent.x3d"), at("scenes/deep/er/broken one.x3d")});
  EXPECT_EQ(both.exitCode, 1);
  EXPECT_NE(both.out.find("use-missing"), std::string::npos);
}

TEST_F(Validate, TellsMachines) {
  const Ran ran = validate({at("scenes"), "--json"});
  const json report = json::parse(ran.out);
  expectFitsSchema(report, "validate.schema.json");
  EXPECT_EQ(report["counts"]["files"], 3);
  EXPECT_EQ(report["counts"]["errors"], 1);
  EXPECT_EQ(report["files"][0]["findings"][0]["rule"], "use-missing");
  EXPECT_EQ(report["files"][0]["findings"][0]["line"], 3);
}

/// What SARIF 2.1.0 demands of the parts that are written.
void expectSarif(const json& log) {
  EXPECT_EQ(log.at("version"), "2.1.0");
  ASSERT_EQ(log.at("runs").size(), 1u);
  const json& run = log.at("runs")[0];
  const json& driver = run.at("tool").at("driver");
  EXPECT_TRUE(driver.at("name").is_string());
  for (const json& invocation : run.at("invocations"))
    EXPECT_TRUE(invocation.at("executionSuccessful").is_boolean());
  for (const json& result : run.at("results")) {
    const std::string level = result.at("level");
    EXPECT_TRUE(level == "error" || level == "warning");
    EXPECT_TRUE(result.at("message").at("text").is_string());
    EXPECT_EQ(driver.at("rules").at(result.at("ruleIndex").get<std::size_t>()).at("id"), result.at("ruleId"));
    const json& place = result.at("locations").at(0).at("physicalLocation");
    const json& artifact =
        run.at("artifacts").at(place.at("artifactLocation").at("index").get<std::size_t>());
    EXPECT_EQ(artifact.at("location").at("uri"), place.at("artifactLocation").at("uri"));
    EXPECT_EQ(place.at("artifactLocation").at("uri").get<std::string>().find(' '), std::string::npos);
    if (!place.contains("region")) continue;
    EXPECT_GE(place["region"].at("startLine").get<int>(), 1);
    EXPECT_GE(place["region"].at("startColumn").get<int>(), 1);
  }
}

TEST_F(Validate, WritesReportsForServers) {
  folder.write("scenes/cut.glb", "glTF");
  const Ran ran = validate({at("scenes"), "--junit", at("junit.xml"), "--sarif", at("log.sarif")});
  EXPECT_EQ(ran.exitCode, 4);
  const json log = json::parse(cloudgen::base::readFile(at("log.sarif")));
  expectSarif(log);
  EXPECT_EQ(log["runs"][0]["results"].size(), 2u);
  const std::string junit = cloudgen::base::readFile(at("junit.xml"));
  EXPECT_NE(junit.find("<testsuite name=\"cloudgen validate\" tests=\"4\" failures=\"2\" errors=\"0\">"),
            std::string::npos)
      << junit;
  EXPECT_EQ(std::system(("xmllint --noout '" + at("junit.xml") + "' >/dev/null 2>&1").c_str()), 0);
}

TEST_F(Validate, ReportsAreWellFormedWhateverTheSceneHolds) {
  folder.write(
      "odd.x3d",
      "<X3D profile=\"Full\" version=\"4.0\"><Scene><Group USE=\"\xc3\xa4&lt;&amp;'\"/></Scene></X3D>");
  folder.write("bytes.wrl", "#VRML V2.0 utf8\nGr\xff\xfe\x01up { }\n");
  const Ran ran = validate(
      {at("odd.x3d"), at("bytes.wrl"), "--junit", at("junit.xml"), "--sarif", at("log.sarif"), "--json"});
  EXPECT_EQ(ran.exitCode, 4);
  expectFitsSchema(json::parse(ran.out), "validate.schema.json");
  expectSarif(json::parse(cloudgen::base::readFile(at("log.sarif"))));
  EXPECT_EQ(std::system(("xmllint --noout '" + at("junit.xml") + "' >/dev/null 2>&1").c_str()), 0);
}

TEST_F(Validate, RefusesWhatWouldEatTheMachine) {
  const std::string head = "<X3D profile='Full' version='4.0'><Scene>";
  std::string laughs = "<!DOCTYPE X3D [<!ENTITY a 'ha'>";
  for (char c = 'b'; c < 'k'; ++c) {
    laughs += std::string("<!ENTITY ") + c + " '";
    for (int i = 0; i < 10; ++i) laughs += std::string("&") + static_cast<char>(c - 1) + ";";
    laughs += "'>";
  }
  folder.write("laughs.x3d", laughs + "]>" + head + "<WorldInfo title='&j;'/></Scene></X3D>");
  folder.write("outside.x3d", "<!DOCTYPE X3D [<!ENTITY a SYSTEM 'file:///etc/hostname'>]>" + head +
                                  "<WorldInfo title='&a;'/></Scene></X3D>");
  std::string points = head + "<Shape><IndexedFaceSet><Coordinate point='";
  while (points.size() < (9u << 20)) points += "0.5 1 -2 ";
  folder.write("gigabyte.x3d", points);
  std::filesystem::resize_file(at("gigabyte.x3d"), std::uintmax_t{1} << 30);  // a hole: nothing is written
  std::string deep = head;
  for (int i = 0; i < 100000; ++i) deep += "<Group>";
  folder.write("deep.x3d", deep);
  for (const auto& [name, rule] : {std::pair<std::string, std::string>{"laughs.x3d", "xml-entity"},
                                   {"outside.x3d", "xml-entity"},
                                   {"gigabyte.x3d", "xml-limit"},
                                   {"deep.x3d", "xml-limit"}}) {
    const Ran ran = validate({at(name)});
    EXPECT_EQ(ran.exitCode, 4) << name;
    EXPECT_NE(ran.out.find("error[" + rule + "]"), std::string::npos) << name << ": " << ran.out;
  }
}

}  // namespace
