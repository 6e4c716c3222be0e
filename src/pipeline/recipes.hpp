// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>

#include "field/cloud_table.hpp"
#include "shape/recipe.hpp"

namespace cloudgen::pipeline {

/// The class of a layer's optical depth, in steps of 2: what its clouds are shaped for.
int layerClassOf(double opticalDepth);

/// True for layers so thin that they are drawn even, as veils: nowhere may they be much thinner still, or
/// they would not be seen as cloud there. Optical depth below 0.7.
constexpr bool isThin(int layerClass) { return layerClass < 0; }

/// One recipe a genus, and what it becomes in a thin layer.
struct RecipeBook {
  std::array<shape::Recipe, base::kGenusCount> recipes, thin;
  const shape::Recipe& of(base::Genus genus, bool isThinLayer = false) const {
    return (isThinLayer ? thin : recipes)[static_cast<size_t>(genus)];
  }
  /// Takes a recipe for its genus.
  void put(const shape::Recipe& recipe);
  const shape::Recipe& of(const field::Layer& layer) const {
    return of(layer.genus, isThin(layerClassOf(layer.opticalDepth())));
  }
};

/// The recipe of a genus where it is thin: a sheet.
shape::Recipe thinned(shape::Recipe recipe);

/// Reads every *.json of a folder, each checked against schemas/recipe.schema.json. Throws InputError naming
/// the file and the place in it; also if a genus has no recipe or two.
RecipeBook readRecipes(const std::filesystem::path& folder);

}  // namespace cloudgen::pipeline
