// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/data_dir.hpp"
#include "cli/command.hpp"
#include "pipeline/recipes.hpp"
#include "writer/catalogue.hpp"

namespace cloudgen::cli {

std::function<int()> setupTypes(CLI::App& options, const Terminal&) {
  const auto asJson = std::make_shared<bool>(false);
  const auto folder = std::make_shared<std::string>();
  options.add_flag("--json", *asJson, "for machines");
  options.add_option("--types", *folder, "folder of recipes (default: the built-in ones)");
  return [asJson, folder] {
    const pipeline::RecipeBook book = pipeline::readRecipes(
        folder->empty() ? base::dataDir() / "templates" / "types" : std::filesystem::path(*folder));
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const base::Genus genus : base::allGenera()) {
      const shape::Recipe& recipe = book.of(genus);
      list.push_back({{"genus", base::abbreviation(genus)},
                      {"name", base::name(genus)},
                      {"width_m", {recipe.widthMeters.low, recipe.widthMeters.high}},
                      {"thickness_m", {recipe.thicknessMeters.low, recipe.thicknessMeters.high}},
                      {"optical_depth", recipe.opticalDepth},
                      {"sheet", recipe.sheet}});
      const bool fromFile = recipe.form == shape::Form::File;
      if (fromFile)
        list.back()["shape"] = recipe.shapeFile;
      else
        list.back()["sections"] = recipe.sections, list.back()["billboards"] = recipe.billboards;
      if (!*asJson)
        print(fmt::format(
            "{:<4} {:<14} {}, {:g}-{:g} m wide, {:g}-{:g} m thick", base::abbreviation(genus),
            base::name(genus),
            fromFile ? recipe.shapeFile
                     : fmt::format("{:>3} sections of {:>2} billboards", recipe.sections, recipe.billboards),
            recipe.widthMeters.low, recipe.widthMeters.high, recipe.thicknessMeters.low,
            recipe.thicknessMeters.high));
    }
    if (*asJson) print(nlohmann::ordered_json{{"types", list}}.dump(2));
    return 0;
  };
}

std::function<int()> setupFormats(CLI::App& options, const Terminal&) {
  const auto asJson = std::make_shared<bool>(false);
  options.add_flag("--json", *asJson, "for machines");
  return [asJson] {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const auto add = [&](std::string_view name, std::string_view description, bool built) {
      list.push_back({{"name", name}, {"description", description}, {"built", built}});
      if (!*asJson) print(fmt::format("{:<7} {}{}", name, description, built ? "" : " (not built yet)"));
    };
    for (const auto& format : writer::formats()) add(format.name, format.description, true);
    for (const auto& [name, description] : writer::formatsNotBuilt()) add(name, description, false);
    if (*asJson) print(nlohmann::ordered_json{{"formats", list}}.dump(2));
    return 0;
  };
}

}  // namespace cloudgen::cli
