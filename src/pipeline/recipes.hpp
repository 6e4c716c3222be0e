// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>

#include "shape/recipe.hpp"

namespace cloudgen::pipeline {

/// One recipe a genus.
struct RecipeBook {
  std::array<shape::Recipe, base::kGenusCount> recipes;
  const shape::Recipe& of(base::Genus genus) const { return recipes[static_cast<size_t>(genus)]; }
};

/// Reads every *.json of a folder, each checked against schemas/recipe.schema.json. Throws InputError naming
/// the file and the place in it; also if a genus has no recipe or two.
RecipeBook readRecipes(const std::filesystem::path& folder);

}  // namespace cloudgen::pipeline
