// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipes.hpp"

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "support/heap_recipe.hpp"
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
  void change(const std::string& what, const std::string& with) {
    ASSERT_FALSE(test::heapRecipeWith(what, with).empty()) << what;
    folder.write("cumulus.json", test::heapRecipeWith(what, with));
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

TEST_F(RecipeFolder, OnesOwnRecipeReplacesTheShippedOne) {
  folder.write("cumulus.json", test::kHeapRecipe);
  EXPECT_FLOAT_EQ(readRecipes(folder.path()).of(base::Genus::Cumulus).opticalDepth, 30);
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
  change("\"count\": 14", "\"count\": \"many\"");
  expectRefused("cumulus.json", "count");
  change("\"sheet\": false", "\"sheet\": false, \"colour\": \"green\"");
  expectRefused("cumulus.json", "colour");
  change("\"optical_depth\": 30,", "");
  expectRefused("cumulus.json", "optical_depth");
  change("\"form\": \"heap\"", "\"form\": \"pile\"");
  expectRefused("cumulus.json", "form");
  change("\"optical_depth\": 30", "\"optical_depth\": -1");
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
