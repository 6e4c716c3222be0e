// SPDX-License-Identifier: Apache-2.0
#include "shape/recipe.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"

namespace cloudgen::shape {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, Form>, 5> kForms{{{"heap", Form::Heap},
                                                                   {"tower", Form::Tower},
                                                                   {"cells", Form::Cells},
                                                                   {"veil", Form::Veil},
                                                                   {"filaments", Form::Filaments}}};

template <class T>
T required(std::optional<T> value, const std::string& where, const std::string& what) {
  if (!value) throw base::InputError(where, what + " is not a known name", "see schemas/recipe.schema.json");
  return *value;
}

Form formFromName(const std::string& name, const std::string& where) {
  for (const auto& [text, form] : kForms)
    if (text == name) return form;
  throw base::InputError(where, "form \"" + name + "\" is not a known name",
                         "see schemas/recipe.schema.json");
}

Placement placementFrom(const json& part, const std::string& where) {
  Placement placement;
  placement.system = required(coordinateSystemFromName(part.at("coordinate_system").get<std::string>()),
                              where, "coordinate_system");
  placement.variant =
      required(placementVariantFromName(part.at("placement").get<std::string>()), where, "placement");
  return placement;
}

Range rangeFrom(const json& pair, const std::string& where) {
  const Range range{pair.at(0), pair.at(1)};
  if (!(range.low > 0) || !(range.high >= range.low))
    throw base::InputError(where, "a range must be [low, high] with 0 < low <= high", "mend the recipe");
  return range;
}

}  // namespace

Recipe recipeFromJson(const std::string& text, const std::string& where) {
  try {
    const json file = json::parse(text);
    Recipe recipe;
    recipe.genus = required(base::genusFromName(file.at("genus").get<std::string>()), where, "genus");
    recipe.form = formFromName(file.at("form"), where);
    recipe.sprites = file.at("sprites");
    const json& sections = file.at("sections");
    recipe.sectionPlacement = placementFrom(sections, where);
    recipe.sections = sections.at("count");
    recipe.sectionRadius = sections.at("radius");
    const json& billboards = file.at("billboards");
    recipe.billboardPlacement = placementFrom(billboards, where);
    recipe.billboards = billboards.at("count");
    recipe.billboardSize = billboards.at("size");
    recipe.flattening = billboards.at("flattening");
    recipe.widthMeters = rangeFrom(file.at("width_m"), where);
    recipe.thicknessMeters = rangeFrom(file.at("thickness_m"), where);
    recipe.opticalDepth = file.at("optical_depth");
    recipe.sheet = file.at("sheet");
    recipe.fibre = file.value("fibre", 0.0f);
    recipe.raggedness = file.value("raggedness", 0.3f);
    recipe.precipitation = file.value("precipitation", 0.0f);
    recipe.alongWind = file.value("along_wind", false);
    recipe.waves = file.value("waves", 0.0f);
    recipe.turrets = file.value("turrets", 0.0f);
    recipe.streets = file.value("streets", 0.0f);
    return recipe;
  } catch (const json::exception& error) {
    throw base::InputError(where, std::string("is not a recipe (") + error.what() + ")",
                           "see schemas/recipe.schema.json");
  }
}

}  // namespace cloudgen::shape
