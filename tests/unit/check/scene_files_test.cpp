// SPDX-License-Identifier: Apache-2.0
#include "check/scene_files.hpp"

#include "base/error.hpp"
#include "support/scratch.hpp"

namespace cloudgen::check::test {
namespace {

namespace fs = std::filesystem;

TEST(SceneFiles, NamesFitPatterns) {
  struct Case {
    const char *pattern, *name;
    bool fits;
  };
  for (const Case& c : {Case{"*.x3d", "a.x3d", true}, Case{"*.x3d", "a.x3dv", false}, Case{"*", "", true},
                        Case{"a*b*c", "axxbyyc", true}, Case{"a*b*c", "axxbyy", false}, Case{"?", "", false},
                        Case{"t[0-9]?", "t5x", true}, Case{"t[!0-9]", "t5", false},
                        Case{"t[!0-9]", "tx", true}, Case{"[", "[", true}, Case{"a[b", "a[b", true},
                        Case{"[]]", "]", true}, Case{"****a", "bbba", true}, Case{"", "a", false}})
    EXPECT_EQ(matchesName(c.pattern, c.name), c.fits) << c.pattern << " " << c.name;
  EXPECT_FALSE(matchesName("*a*a*a*a*a*a*a*a*b", std::string(5000, 'a')));
}

TEST(SceneFiles, FoldersAndPatternsFindEachFileOnce) {
  const cloudgen::test::Scratch folder;
  fs::create_directories(folder.path() / "a/b");
  fs::create_directory_symlink(folder.path(), folder.path() / "a/loop");
  for (const char* name :
       {"one.x3d", "two.WRL", "a/three.glb", "a/b/four.x3dv", "a/b/five.txt", ".six.x3d", "[7].x3d"})
    folder.write(name, "");
  const auto found = [&](std::vector<std::string> words) {
    std::string all;
    for (std::string& word : words) word = (folder.path() / word).string();
    for (const fs::path& file : sceneFiles(words))
      all += file.lexically_relative(folder.path()).string() + ' ';
    return all;
  };
  EXPECT_EQ(found({""}), "[7].x3d a/b/four.x3dv a/three.glb one.x3d two.WRL ");
  EXPECT_EQ(found({"**/*.x3d*"}), "[7].x3d a/b/four.x3dv one.x3d ");
  EXPECT_EQ(found({"a/**"}), "a/b/five.txt a/b/four.x3dv a/three.glb ");
  EXPECT_EQ(found({"*/*/*.x3dv", "a", "one.x3d", "./one.x3d"}), "a/b/four.x3dv a/three.glb one.x3d ");
  EXPECT_EQ(found({".*.x3d"}), ".six.x3d ");
  EXPECT_EQ(found({"[7].x3d"}), "[7].x3d ");
  EXPECT_EQ(found({"absent.x3d"}), "absent.x3d ");  // whoever opens it says so
  EXPECT_THROW(found({"*.gltf"}), base::InputError);
  fs::create_directory(folder.path() / "empty");
  EXPECT_THROW(found({"empty"}), base::InputError);
}

}  // namespace
}  // namespace cloudgen::check::test
