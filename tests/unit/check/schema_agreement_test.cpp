// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>
#include <set>

#include "check/xsd/validate_x3d.hpp"
#include "support/scratch.hpp"
#include "unit/check/broken_scenes.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

namespace fs = std::filesystem;

bool xmllintIsThere() { return std::system("xmllint --version >/dev/null 2>&1") == 0; }

/// The files that xmllint accepts, by number. One run, as compiling the official schema takes a second.
std::set<std::size_t> xmllintAccepts(const fs::path& schema, const std::vector<std::string>& scenes) {
  const cloudgen::test::Scratch folder;
  for (std::size_t i = 0; i < scenes.size(); ++i) folder.write(std::to_string(i) + ".x3d", scenes[i]);
  const std::string log = folder.path() / "log";
  const int code = std::system(("cd '" + folder.path().string() + "' && xmllint --nonet --noout --schema '" +
                                fs::absolute(schema).string() + "' $(ls *.x3d) 2>" + log)
                                   .c_str());
  EXPECT_NE(code, -1);
  std::set<std::size_t> accepted;
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (line.ends_with(".x3d validates")) accepted.insert(std::stoul(line));
  return accepted;
}

bool hasSchemaFinding(const ValidationResult& result) {
  for (const Finding& finding : result.findings)
    if (finding.rule == "schema" || finding.rule == "xml-malformed") return true;
  return false;
}

TEST(SchemaAgreement, WhatOursAcceptsTheOfficialAccepts) {
  if (!fs::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  const SceneFolder folder;
  for (const auto& [what, scene] : goodScenes()) {
    const ValidationResult result = validateX3dText(scene, "scene.x3d", officialSchema(), folder.path());
    EXPECT_EQ(texts(result), "") << what;
  }
}

/// Good and broken scenes, and variations in how values are written.
std::vector<std::string> corpus() {
  std::vector<std::string> scenes;
  for (const auto& [what, scene] : goodScenes()) scenes.push_back(scene);
  for (const Broken& broken : brokenScenes()) {
    // What libxml2 alone allows (entities, other encodings) or knows only in memory (a name given twice).
    if (broken.rule == "xml-entity" || broken.rule == "xml-encoding" || broken.rule == "def-duplicate")
      continue;
    scenes.push_back(edited(goodScene(), broken.from, broken.to));
  }
  for (const char* value : {"1 2 3",
                            " 1\t2\n3 ",
                            "1,2,3",
                            "1, 2, 3",
                            "1 2 3,",
                            "+1 -2 .5",
                            "1. 2. 3.",
                            "01 2 3",
                            "1 2 3 4",
                            "1e5 2E-5 3e+5",
                            "1 2",
                            "",
                            "&#x9;1 2 3",
                            "1\xc2\xa0"
                            "2 3",
                            "inf 0 0",
                            "1 2 3 , ,",
                            "--1 2 3",
                            "1e 2 3",
                            "1.5.5 2 3",
                            "1 2 3.5.5"}) {
    scenes.push_back(
        edited(goodScene(), R"(translation="1 2 3")", std::string("translation=\"") + value + '"'));
    scenes.push_back(edited(goodScene(), R"(<Coordinate point="0 0 0 1 1 1"/>)",
                            std::string("<Coordinate point=\"0 0 0 ") + value + "\"/>"));
    scenes.push_back(
        edited(goodScene(), R"(coordIndex="0 1 -1")", std::string("coordIndex=\"") + value + '"'));
    scenes.push_back(edited(goodScene(), R"(range="100 1000")", std::string("range=\"") + value + '"'));
    scenes.push_back(edited(goodScene(), R"(<Color color="1 1 1 0 0 0"/>)",
                            std::string("<Color color=\"") + value + "\"/>"));
    scenes.push_back(edited(goodScene(), R"(bboxSize="1 1 1")", std::string("bboxSize=\"") + value + '"'));
  }
  return scenes;
}

void expectVerdictOfXmllint(const XmlSchema& schema, const fs::path& file) {
  const std::vector<std::string> scenes = corpus();
  const std::set<std::size_t> accepted = xmllintAccepts(file, scenes);
  EXPECT_GT(accepted.size(), 40u);
  EXPECT_LT(accepted.size(), scenes.size() - 40);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    EXPECT_EQ(!hasSchemaFinding(validateX3dText(scenes[i], "scene.x3d", schema)), accepted.contains(i))
        << scenes[i];
}

TEST(SchemaAgreement, XmllintGivesTheSameVerdict) {
  if (!xmllintIsThere()) GTEST_SKIP() << "xmllint is not installed";
  expectVerdictOfXmllint(profileSchema(), profileSchemaFile());
  if (fs::exists(officialSchemaFile())) expectVerdictOfXmllint(officialSchema(), officialSchemaFile());
}

TEST(SchemaAgreement, WhatTheOfficialRejectsOursRejects) {
  if (!fs::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  const SceneFolder folder;
  for (const Broken& broken : brokenScenes()) {
    if (!broken.bySchema) continue;
    const std::string scene = edited(goodScene(), broken.from, broken.to);
    EXPECT_TRUE(hasSchemaFinding(validateX3dText(scene, "scene.x3d", officialSchema(), folder.path())))
        << broken.what;
    EXPECT_TRUE(hasSchemaFinding(validateX3dText(scene, "scene.x3d", profileSchema(), folder.path())))
        << broken.what;
  }
}

TEST(SchemaAgreement, NodesOutsideOfOurProfileAreReadUnderTheOfficialSchema) {
  if (!fs::exists(officialSchemaFile())) GTEST_SKIP() << "the official X3D schemas are not here";
  const std::string scene = R"(<X3D profile="Full" version="4.0"><Scene>
<ProtoDeclare name="Cloud"><ProtoBody><Group DEF="Body"><Group USE="Body2"/></Group></ProtoBody></ProtoDeclare>
<Shape><Box DEF="Box" size="1 1 1"/></Shape><TouchSensor DEF="Touch"/><Group DEF="Body"/>
<ROUTE fromNode="Touch" fromField="touchTime" toNode="Nobody" toField="startTime"/>
</Scene></X3D>)";
  const ValidationResult result = validateX3dText(scene, "scene.x3d", officialSchema());
  ASSERT_EQ(result.findings.size(), 2u) << texts(result);
  EXPECT_EQ(result.findings[0].rule, "use-missing");
  EXPECT_EQ(result.findings[1].rule, "route-node");
}

}  // namespace
}  // namespace cloudgen::check::test
