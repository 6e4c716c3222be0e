// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "base/error.hpp"
#include "check/catalogue.hpp"
#include "check/xsd/validate_x3d.hpp"
#include "unit/check/good_scene.hpp"

namespace cloudgen::check::test {
namespace {

TEST(GoodX3d, HasNoFindings) {
  const SceneFolder folder;
  for (const auto& [what, scene] : goodScenes())
    EXPECT_EQ(texts(validateX3dText(scene, "scene.x3d", profileSchema(), folder.path())), "") << what;
}

TEST(GoodX3d, IsValidFromDiskAndCounted) {
  const SceneFolder folder;
  const auto file = folder.path() / "scene.x3d";
  const std::string scene = goodScene();
  std::ofstream(file) << scene;
  const ValidationResult result = validateFile(file, profileSchemaFile(), {});
  EXPECT_EQ(texts(result), "");
  EXPECT_TRUE(result.valid());
  EXPECT_EQ(result.bytes, scene.size());
  EXPECT_EQ(result.nodes, 47u);
  EXPECT_GT(result.elements, result.nodes);
}

TEST(GoodX3d, UrlsElsewhereAreReportedAndNeverErrors) {
  const SceneFolder folder;
  for (const std::string url :
       {"https://example.org/a.png", "../a.png", "/etc/passwd", "tiles/../../a.png", "file:///etc/passwd"}) {
    const std::string scene = edited(goodScene(), "'\"cloud.png\"'", "'\"" + url + "\"'");
    const ValidationResult result = validateX3dText(scene, "scene.x3d", profileSchema(), folder.path());
    EXPECT_TRUE(result.valid()) << url;
    ASSERT_EQ(result.findings.size(), 1u) << url;
    EXPECT_EQ(result.findings[0].rule, "url-outside");
    EXPECT_EQ(result.findings[0].line, lineOf(scene, url));
  }
}

TEST(GoodX3d, MissingFilesAndForeignKindsAreInputErrors) {
  const SceneFolder folder;
  EXPECT_THROW(validateFile(folder.path() / "absent.x3d", profileSchemaFile(), {}), base::InputError);
  EXPECT_THROW(validateFile(folder.path(), profileSchemaFile(), {}), base::InputError);
  EXPECT_THROW(validateFile(folder.path() / "cloud.png", profileSchemaFile(), {}), base::InputError);
  EXPECT_THROW(validateFile(folder.path() / "tiles/0.x3d", folder.path() / "absent.xsd", {}),
               base::InputError);
  EXPECT_THROW(validateFile(folder.path() / "tiles/0.x3d", folder.path() / "cloud.png", {}),
               base::InputError);
}

TEST(GoodX3d, CanBeInterrupted) {
  const SceneFolder folder;
  const auto file = folder.path() / "scene.x3d";
  base::Progress progress;
  progress.cancelled = [] { return true; };
  std::ofstream(file) << R"(<X3D profile="Full" version="4.0"><Scene>)" << [] {
    std::string groups;
    while (groups.size() < (6u << 20)) groups += "<Group/>";
    return groups;
  }() << "</Scene></X3D>";
  EXPECT_THROW(validateFile(file, profileSchemaFile(), progress), base::InterruptedError);
}

}  // namespace
}  // namespace cloudgen::check::test
