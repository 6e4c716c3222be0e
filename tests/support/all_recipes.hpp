// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/data_dir.hpp"
#include "base/file.hpp"
#include "shape/recipe.hpp"

namespace cloudgen::test {

inline std::filesystem::path recipeFile(base::Genus genus) {
  return base::dataDir() / "templates" / "types" / (std::string(base::name(genus)) + ".json");
}

inline shape::Recipe recipeOf(base::Genus genus) {
  const std::filesystem::path file = recipeFile(genus);
  return shape::recipeFromJson(base::readFile(file), file.string());
}

/// The recipes that users get, in the order of the genera.
inline std::vector<shape::Recipe> allRecipes() {
  std::vector<shape::Recipe> recipes;
  for (const base::Genus genus : base::allGenera()) recipes.push_back(recipeOf(genus));
  return recipes;
}

}  // namespace cloudgen::test
