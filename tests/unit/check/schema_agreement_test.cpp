// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>

#include "check/xsd/validate_x3d.hpp"
#include "unit/check/broken_scenes.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

namespace fs = std::filesystem;

bool xmllintIsThere() { return std::system("xmllint --version >/dev/null 2>&1") == 0; }

bool xmllintAccepts(const fs::path& schema, const fs::path& scene) {
  return std::system(("xmllint --nonet --noout --schema '" + schema.string() + "' '" + scene.string() +
                      "' >/dev/null 2>&1")
                         .c_str()) == 0;
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

TEST(SchemaAgreement, XmllintGivesTheSameVerdictUnderOurSchema) {
  if (!xmllintIsThere()) GTEST_SKIP() << "xmllint is not installed";
  const SceneFolder folder;
  const fs::path file = folder.path() / "scene.x3d";
  for (const Broken& broken : brokenScenes()) {
    // What libxml2 alone allows (entities) or knows only in memory (a name given twice).
    if (broken.rule == "xml-entity" || broken.rule == "xml-encoding" || broken.rule == "def-duplicate")
      continue;
    const std::string scene = edited(goodScene(), broken.from, broken.to);
    std::ofstream(file) << scene;
    const bool ours = !hasSchemaFinding(validateX3dText(scene, "scene.x3d", profileSchema(), folder.path()));
    EXPECT_EQ(ours, xmllintAccepts(profileSchemaFile(), file)) << broken.what;
  }
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
