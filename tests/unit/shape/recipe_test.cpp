// SPDX-License-Identifier: Apache-2.0
#include "shape/recipe.hpp"

#include "base/error.hpp"
#include "support/all_recipes.hpp"
#include "support/heap_recipe.hpp"

namespace cloudgen::shape {
namespace {

void expectRefused(const std::string& text, const std::string& saying) {
  try {
    recipeFromJson(text, "my.json");
    ADD_FAILURE() << "accepted, should say " << saying;
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.where(), "my.json");
    EXPECT_NE(error.problem().find(saying), std::string::npos) << error.problem();
    EXPECT_FALSE(error.hint().empty());
  }
}

TEST(Recipe, EveryGenusHasOne) {
  for (const base::Genus genus : base::allGenera()) {
    const Recipe recipe = test::recipeOf(genus);
    EXPECT_EQ(recipe.genus, genus);
    EXPECT_GT(recipe.sections, 0);
    EXPECT_GT(recipe.billboards, 0);
    EXPECT_GT(recipe.opticalDepth, 0);
  }
}

TEST(Recipe, WhatTheFileSaysIsRead) {
  const Recipe recipe = recipeFromJson(test::heapRecipeWith("\"count\": 14", "\"count\": 9"), "my.json");
  EXPECT_EQ(recipe.form, Form::Heap);
  EXPECT_EQ(recipe.sections, 9);
  EXPECT_EQ(recipe.sectionPlacement.system, CoordinateSystem::HalfSpherical);
  EXPECT_FLOAT_EQ(recipe.widthMeters.low, 500);
  EXPECT_FLOAT_EQ(recipe.widthMeters.high, 4000);
  EXPECT_FALSE(recipe.sheet);
  EXPECT_FALSE(recipe.alongWind);
}

constexpr const char* kFileRecipe = R"({"genus": "Cu", "form": "file", "sheet": false, "optical_depth": 30,
  "shape": {"file": "a.obj", "up": "z", "flat_base": true}, "width_m": [500, 4000], "thickness_m": [250, 5000]})";

TEST(Recipe, AFormFromAFileNeedsNoSections) {
  const Recipe recipe = recipeFromJson(kFileRecipe, "my.json");
  EXPECT_EQ(recipe.form, Form::File);
  EXPECT_EQ(recipe.shapeFile, "a.obj");
  EXPECT_TRUE(recipe.zUp);
  EXPECT_TRUE(recipe.flatBase);
  std::string other = kFileRecipe;
  expectRefused(other.replace(other.find("file"), 4, "heap"), "has a shape");
  expectRefused(test::heapRecipeWith("\"form\": \"heap\"", "\"form\": \"file\""), "shape");
}

TEST(Recipe, WhatIsWrongIsNamed) {
  expectRefused(test::kHeapRecipe + std::string("}"), "is not a recipe");
  expectRefused("", "is not a recipe");
  expectRefused("[]", "is not a recipe");
  expectRefused(test::heapRecipeWith("\"genus\": \"Cu\"", "\"genus\": \"Xy\""), "genus");
  expectRefused(test::heapRecipeWith("\"form\": \"heap\"", "\"form\": \"pile\""), "pile");
  expectRefused(test::heapRecipeWith("half_spherical", "toroidal"), "coordinate_system");
  expectRefused(test::heapRecipeWith("\"placement\": \"uniform\"", "\"placement\": \"dense\""), "placement");
  expectRefused(test::heapRecipeWith("\"size\": 0.3", "\"size\": 0.3, \"placement\": \"uniform\""),
                "placement");
  expectRefused(
      test::heapRecipeWith("\"coordinate_system\": \"spherical\"", "\"coordinate_system\": \"cubic\""),
      "neither");
  expectRefused(test::heapRecipeWith("\"form\": \"heap\"", "\"form\": \"veil\""), "coordinate_system");
  expectRefused(test::heapRecipeWith("\"width_m\": [500, 4000]", "\"width_m\": [4000, 500]"), "low <= high");
  expectRefused(test::heapRecipeWith("\"width_m\": [500, 4000]", "\"width_m\": [0, 500]"), "low");
  expectRefused(test::heapRecipeWith("\"width_m\": [500, 4000]", "\"width_m\": [500]"), "is not a recipe");
  expectRefused(test::heapRecipeWith("\"sheet\": false", "\"sheet\": \"no\""), "is not a recipe");
  expectRefused(test::heapRecipeWith("\"optical_depth\": 30,", ""), "optical_depth");
}

}  // namespace
}  // namespace cloudgen::shape
