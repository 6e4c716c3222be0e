// SPDX-License-Identifier: Apache-2.0
#include "base/file.hpp"

#include "base/error.hpp"
#include "support/scratch.hpp"

namespace cloudgen::base {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(File, GivesBackWhatWasWritten) {
  const test::Scratch scratch;
  const std::string bytes("a\0b\r\n\xff", 6);
  writeFile(scratch.path() / "x", bytes);
  EXPECT_EQ(readFile(scratch.path() / "x"), bytes);
  EXPECT_EQ(entries(scratch.path()), 1u);
}

TEST(File, RefusesWhatIsNoFileOfDecentSize) {
  const test::Scratch scratch;
  EXPECT_THROW(readFile(scratch.path() / "missing"), InputError);
  EXPECT_THROW(readFile(scratch.path()), InputError);
  EXPECT_THROW(readFile(scratch.write("big", "12345"), 4), InputError);
  EXPECT_THROW(writeFile(scratch.path() / "no" / "folder", "x"), OutputError);
}

TEST(StagedFolder, LeavesNothingBehindWithoutCommit) {
  const test::Scratch scratch;
  {
    const StagedFolder staged(scratch.path() / "out", false);
    writeFile(staged.path() / "half", "written");
  }
  EXPECT_EQ(entries(scratch.path()), 0u);
}

TEST(StagedFolder, AppearsWholeOnCommit) {
  const test::Scratch scratch;
  {
    StagedFolder staged(scratch.path() / "out/", false);
    writeFile(staged.path() / "report.json", "{}");
    EXPECT_FALSE(fs::exists(scratch.path() / "out"));
    staged.commit();
  }
  EXPECT_EQ(entries(scratch.path()), 1u);
  EXPECT_EQ(readFile(scratch.path() / "out" / "report.json"), "{}");
}

TEST(StagedFolder, ReplacesOnlyItsOwnOutputAndOnlyWhenAsked) {
  const test::Scratch scratch;
  const fs::path out = scratch.path() / "out";
  fs::create_directory(out);
  EXPECT_NO_THROW(StagedFolder(out, false)) << "an empty folder may be filled";
  writeFile(out / "thesis.tex", "precious");
  EXPECT_THROW(StagedFolder(out, false), OutputError);
  EXPECT_THROW(StagedFolder(out, true), OutputError) << "not ours";
  writeFile(out / "report.json", "{}");
  EXPECT_THROW(StagedFolder(out, false), OutputError);
  StagedFolder staged(out, true);
  writeFile(staged.path() / "report.json", "new");
  staged.commit();
  EXPECT_EQ(readFile(out / "report.json"), "new");
  EXPECT_FALSE(fs::exists(out / "thesis.tex"));
  EXPECT_EQ(entries(scratch.path()), 1u);
}

TEST(StagedFolder, NeedsAParentAndNoFileInItsPlace) {
  const test::Scratch scratch;
  EXPECT_THROW(StagedFolder(scratch.path() / "no" / "out", false), OutputError);
  EXPECT_THROW(StagedFolder(scratch.write("out", "a file"), true), OutputError);
}

}  // namespace
}  // namespace cloudgen::base
