// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/recipes.hpp"
#include "scene/scene.hpp"

namespace cloudgen::cli {

/// The shape that a command line names.
struct ShapeLine {
  std::string file;      ///< empty: none
  std::string variable;  ///< of a volume with several
  bool zUp = false;
};

/// Gives the shape of the command line to the genera whose clouds are separate heaps (cumulus and
/// cumulonimbus), and opens the files of all recipes that name one. Throws InputError.
void openShapes(pipeline::RecipeBook& recipes, const ShapeLine& line);

/// "shapes" of the report: for each genus whose recipe names a file how many clouds it has, and of the
/// archetype that most of them have how many puffs; for a volume also how far these are from it
/// (shape::FileShape::opticalDepthErrors).
nlohmann::ordered_json shapesOf(const pipeline::RecipeBook& recipes, const scene::Scene& scene);

}  // namespace cloudgen::cli
