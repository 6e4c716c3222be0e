// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "check/xsd/validate_x3d.hpp"
#include "unit/check/broken_scenes.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

TEST(BrokenX3d, IsFoundByItsRuleOnItsLine) {
  const SceneFolder folder;
  const std::string good = goodScene();
  EXPECT_GE(brokenScenes().size(), 50u);
  for (const Broken& broken : brokenScenes()) {
    const ValidationResult result =
        validateX3dText(edited(good, broken.from, broken.to), "scene.x3d", profileSchema(), folder.path());
    EXPECT_FALSE(result.valid()) << broken.what;
    const auto line =
        static_cast<std::uint64_t>(static_cast<int>(lineOf(good, broken.from)) + broken.lineOffset);
    const bool found =
        std::any_of(result.findings.begin(), result.findings.end(), [&](const Finding& finding) {
          return finding.rule == broken.rule && finding.line == line && finding.column > 0 &&
                 !finding.message.empty() && !finding.hint.empty();
        });
    EXPECT_TRUE(found) << broken.what << ": expected " << broken.rule << " on line " << line << ", got\n"
                       << texts(result);
  }
}

TEST(BrokenX3d, WhatTheSchemaAllowsIsNamedOnce) {
  const SceneFolder folder;
  for (const Broken& broken : brokenScenes()) {
    const bool ours = broken.rule.starts_with("use-") || broken.rule.starts_with("route-") ||
                      broken.rule.starts_with("lod-") || broken.rule.starts_with("key-");
    if (!ours) continue;
    const ValidationResult result = validateX3dText(edited(goodScene(), broken.from, broken.to), "scene.x3d",
                                                    profileSchema(), folder.path());
    EXPECT_LE(result.findings.size(), 2u) << broken.what << "\n" << texts(result);
  }
}

TEST(BrokenX3d, FindingsStandInTheOrderOfTheFile) {
  std::string scene = edited(goodScene(), R"(scale="1 1 1")", R"(scale="0 0 0")");
  scene = edited(scene, R"(USE="Puff")", R"(USE="Nobody")");
  scene = edited(scene, R"(key="0 0.5 1")", R"(key="1 0.5 0")");
  const ValidationResult result = validateX3dText(scene, "scene.x3d", profileSchema());
  ASSERT_EQ(result.findings.size(), 3u) << texts(result);
  EXPECT_EQ(result.findings[0].rule, "scale-zero");
  EXPECT_EQ(result.findings[1].rule, "use-missing");
  EXPECT_EQ(result.findings[2].rule, "key-order");
  EXPECT_EQ(text(result.findings[0]).substr(0, 28), "scene.x3d:25:69: error[scale");
}

}  // namespace
}  // namespace cloudgen::check::test
