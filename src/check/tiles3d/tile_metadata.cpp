// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/tile_metadata.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "check/gltf/gltf_elements.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {
namespace {

bool fitsType(const Json& value, const Json& property) {
  const Json& type = member(property, "type");
  if (member(property, "array") == true) return value.is_array();
  if (type == "STRING" || type == "ENUM") return value.is_string();
  if (type == "BOOLEAN") return value.is_boolean();
  if (type != "SCALAR") return value.is_array();
  const Json& component = member(property, "componentType");
  const bool isWhole = component.is_string() && component.get<std::string>().find("INT") != std::string::npos;
  const bool isUnsigned = component.is_string() && component.get<std::string>().starts_with("UINT");
  if (isWhole && member(property, "normalized") != true)
    return value.is_number_integer() && (!isUnsigned || value >= 0);
  return value.is_number();
}

}  // namespace

std::string metadataFault(const Json& metadata, const Json& schema) {
  if (!schema.is_object()) return "is there without a schema";
  const Json& name = member(metadata, "class");
  if (!name.is_string()) return "names no class";
  const Json& kind = member(member(schema, "classes"), name.get<std::string>().c_str());
  if (!kind.is_object()) return "names the class " + excerpt(name.get<std::string>()) + ", which the schema has not";
  const Json& known = member(kind, "properties");
  const Json& properties = member(metadata, "properties");
  if (properties.is_object())
    for (const auto& [id, value] : properties.items()) {
      const Json& property = member(known, id.c_str());
      if (!property.is_object()) return "has " + excerpt(id) + ", which its class has not";
      if (!fitsType(value, property)) return "has " + excerpt(id) + " of another type than its class";
    }
  if (known.is_object())
    for (const auto& [id, property] : known.items())
      if (member(property, "required") == true && !properties.contains(id))
        return "lacks " + excerpt(id) + ", which its class demands";
  return {};
}

}  // namespace cloudgen::check
