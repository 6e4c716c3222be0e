// SPDX-License-Identifier: Apache-2.0
#include "shape/recipe.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"

namespace cloudgen::shape {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, Form>, 6> kForms{{{"heap", Form::Heap},
                                                                   {"tower", Form::Tower},
                                                                   {"cells", Form::Cells},
                                                                   {"veil", Form::Veil},
                                                                   {"filaments", Form::Filaments},
                                                                   {"file", Form::File}}};

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

CoordinateSystem systemFrom(const json& part, const std::string& where) {
  return required(coordinateSystemFromName(part.at("coordinate_system").get<std::string>()), where,
                  "coordinate_system");
}

Placement placementFrom(const json& part, const std::string& where) {
  Placement placement;
  placement.system = systemFrom(part, where);
  placement.variant =
      required(placementVariantFromName(part.at("placement").get<std::string>()), where, "placement");
  return placement;
}

/// What would not be obeyed is refused.
void refuseField(const json& part, const char* field, const std::string& where) {
  if (part.contains(field))
    throw base::InputError(where, std::string("has a ") + field + " where its form has its own",
                           "take it out; see schemas/recipe.schema.json");
}

Range rangeFrom(const json& pair, const std::string& where) {
  const Range range{pair.at(0), pair.at(1)};
  if (!(range.low > 0) || !(range.high >= range.low))
    throw base::InputError(where, "a range must be [low, high] with 0 < low <= high", "mend the recipe");
  return range;
}

/// Sections and billboards. Heaps (towers too wide for their depth are told as such) and filaments scatter
/// sections, cells and veils billboards; in the
/// lobes of heaps and towers billboards lie about whole balls or their upper halves.
void readParts(const json& file, const std::string& where, Recipe& recipe) {
  const bool ofLobes = recipe.form == Form::Heap || recipe.form == Form::Tower,
             scattersSections = ofLobes || recipe.form == Form::Filaments,
             scattersBillboards = recipe.form == Form::Cells || recipe.form == Form::Veil;
  const json& sections = file.at("sections");
  if (scattersSections) {
    recipe.sectionPlacement = placementFrom(sections, where);
  } else {
    refuseField(sections, "coordinate_system", where);
    refuseField(sections, "placement", where);
  }
  recipe.sections = sections.at("count");
  recipe.sectionRadius = sections.at("radius");
  const json& billboards = file.at("billboards");
  if (scattersBillboards) {
    recipe.billboardPlacement = placementFrom(billboards, where);
  } else {
    refuseField(billboards, "placement", where);
    if (ofLobes)
      recipe.billboardPlacement.system = systemFrom(billboards, where);
    else
      refuseField(billboards, "coordinate_system", where);
    if (ofLobes && recipe.billboardPlacement.system != CoordinateSystem::Spherical &&
        recipe.billboardPlacement.system != CoordinateSystem::HalfSpherical)
      throw base::InputError(where, "has billboards in lobes that are neither spherical nor half_spherical",
                             "take one of the two");
  }
  recipe.billboards = billboards.at("count");
  recipe.billboardSize = billboards.at("size");
  recipe.flattening = billboards.at("flattening");
}

void readShapeFile(const json& shape, Recipe& recipe) {
  recipe.shapeFile = shape.at("file");
  recipe.shapeVariable = shape.value("variable", std::string());
  recipe.zUp = shape.value("up", std::string("y")) == "z";
  recipe.flatBase = shape.value("flat_base", false);
}

}  // namespace

Recipe recipeFromJson(const std::string& text, const std::string& where) {
  try {
    const json file = json::parse(text);
    Recipe recipe;
    recipe.genus = required(base::genusFromName(file.at("genus").get<std::string>()), where, "genus");
    recipe.form = formFromName(file.at("form"), where);
    if (recipe.form == Form::File) {
      readShapeFile(file.at("shape"), recipe);
      refuseField(file, "sections", where);
      refuseField(file, "billboards", where);
    } else {
      refuseField(file, "shape", where);
      readParts(file, where, recipe);
    }
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
