// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipes.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr std::uint64_t kRecipeLimitBytes = 1 << 20;

nlohmann::json parsed(const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(base::readFile(file, kRecipeLimitBytes));
  } catch (const nlohmann::json::exception& error) {
    throw base::InputError(file.string(), std::string("is not JSON (") + error.what() + ")",
                           "mend the recipe");
  }
}

void checkAgainstSchema(const valijson::Schema& schema, const nlohmann::json& recipe,
                        const std::string& where) {
  valijson::Validator validator;
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter adapter(recipe);
  if (validator.validate(schema, adapter, &results)) return;
  valijson::ValidationResults::Error error;
  results.popError(error);
  std::string place;
  for (const std::string& part : error.context) place += part;
  throw base::InputError(where + " " + place, error.description, "see schemas/recipe.schema.json");
}

}  // namespace

int layerClassOf(double opticalDepth) {
  return static_cast<int>(std::lround(std::log2(std::clamp(opticalDepth, 0.01, 1e4))));
}

shape::Recipe thinned(shape::Recipe recipe) {
  recipe.sheet = true;
  recipe.precipitation = 0;
  return recipe;
}

void RecipeBook::put(const shape::Recipe& recipe) {
  recipes[static_cast<size_t>(recipe.genus)] = recipe;
  thin[static_cast<size_t>(recipe.genus)] = thinned(recipe);
}

RecipeBook readRecipes(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw base::InputError(folder.string(), "is not a folder of recipes",
                           "point --types at a folder like templates/types");
  valijson::Schema schema;
  const nlohmann::json schemaText = parsed(base::dataDir() / "schemas" / "recipe.schema.json");
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schemaText), schema);

  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  RecipeBook book;
  std::array<std::string, base::kGenusCount> from;
  for (const auto& file : files) {
    const nlohmann::json json = parsed(file);
    checkAgainstSchema(schema, json, file.string());
    shape::Recipe recipe = shape::recipeFromJson(json.dump(), file.string());
    std::string& first = from[static_cast<size_t>(recipe.genus)];
    if (!first.empty())
      throw base::InputError(
          file.string(),
          "is a second recipe for " + std::string(base::name(recipe.genus)) + " beside " + first,
          "keep one of them");
    first = file.filename().string();
    if (!recipe.shapeFile.empty()) recipe.shapeFile = (file.parent_path() / recipe.shapeFile).string();
    book.put(recipe);
  }
  for (const base::Genus genus : base::allGenera())
    if (from[static_cast<size_t>(genus)].empty())
      throw base::InputError(folder.string(), "has no recipe for " + std::string(base::name(genus)),
                             "copy the one of templates/types and change it");
  return book;
}

}  // namespace cloudgen::pipeline
