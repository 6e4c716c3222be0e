// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipes.hpp"

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "support/scratch.hpp"

namespace cloudgen::pipeline {
namespace {

std::filesystem::path shipped() { return base::dataDir() / "templates" / "types"; }

class RecipeFolder : public testing::Test {
 protected:
  RecipeFolder() {
    for (const auto& entry : std::filesystem::directory_iterator(shipped()))
      std::filesystem::copy(entry.path(), folder.path());
  }
  void change(const std::string& file, const std::string& what, const std::string& with) {
    std::string text = base::readFile(shipped() / file);
    ASSERT_NE(text.find(what), std::string::npos);
    folder.write(file, text.replace(text.find(what), what.size(), with));
  }
  void expectRefused(const std::string& where, const std::string& saying) {
    try {
      readRecipes(folder.path());
      ADD_FAILURE() << "accepted, should say " << saying;
    } catch (const base::InputError& error) {
      EXPECT_NE(error.where().find(where), std::string::npos) << error.what();
      EXPECT_NE((error.where() + error.problem()).find(saying), std::string::npos) << error.what();
    }
  }
  test::Scratch folder;
};

TEST_F(RecipeFolder, TheShippedOnesAreOneAGenus) {
  const RecipeBook book = readRecipes(folder.path());
  for (const base::Genus genus : base::allGenera()) EXPECT_EQ(book.of(genus).genus, genus);
}

TEST_F(RecipeFolder, OtherFilesDoNotMatter) {
  folder.write("README.md", "not a recipe");
  EXPECT_NO_THROW(readRecipes(folder.path()));
}

TEST_F(RecipeFolder, AMissingGenusIsNamed) {
  std::filesystem::remove(folder.path() / "cirrus.json");
  expectRefused(folder.path().string(), "cirrus");
}

TEST_F(RecipeFolder, TwoForOneGenusAreRefused) {
  folder.write("my_cumulus.json", base::readFile(shipped() / "cumulus.json"));
  expectRefused("my_cumulus.json", "cumulus.json");
}

TEST_F(RecipeFolder, WhatTheSchemaForbidsIsRefusedWithItsPlace) {
  change("cumulus.json", "\"count\": 14", "\"count\": \"many\"");
  expectRefused("cumulus.json", "count");
  change("cumulus.json", "\"sheet\": false", "\"sheet\": false, \"colour\": \"green\"");
  expectRefused("cumulus.json", "colour");
  change("cumulus.json", "\"optical_depth\": 30,", "");
  expectRefused("cumulus.json", "optical_depth");
  change("cumulus.json", "\"form\": \"heap\"", "\"form\": \"pile\"");
  expectRefused("cumulus.json", "form");
  change("cumulus.json", "\"optical_depth\": 30", "\"optical_depth\": -1");
  expectRefused("cumulus.json", "optical_depth");
}

TEST_F(RecipeFolder, BrokenJsonIsRefused) {
  folder.write("fog.json", "{\"genus\": ");
  expectRefused("fog.json", "is not JSON");
}

TEST_F(RecipeFolder, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(readRecipes(folder.path() / "none"), base::InputError);
}

}  // namespace
}  // namespace cloudgen::pipeline
