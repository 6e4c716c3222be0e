// SPDX-License-Identifier: Apache-2.0
#include "check/rules/profiles.hpp"

#include "check/rules/node_table.hpp"

namespace cloudgen::check {

std::map<std::string, int, std::less<>> componentsOf(std::string_view profile) {
  if (profile == "Core") return {{"Core", 1}};
  if (profile == "Interchange" || profile == "CADInterchange" || profile == "MedicalInterchange")
    return {{"Core", 1},      {"Time", 1},          {"Networking", 1}, {"Grouping", 1},
            {"Rendering", 3}, {"Shape", 1},         {"Geometry3D", 2}, {"Lighting", 1},
            {"Texturing", 2}, {"Interpolation", 2}, {"Navigation", 1}, {"EnvironmentalEffects", 1}};
  if (profile == "Interactive" || profile == "MPEG4Interactive")
    return {{"Core", 1},      {"Time", 1},          {"Networking", 2}, {"Grouping", 2},
            {"Rendering", 3}, {"Shape", 1},         {"Geometry3D", 3}, {"Lighting", 2},
            {"Texturing", 2}, {"Interpolation", 2}, {"Navigation", 1}, {"EnvironmentalEffects", 1}};
  if (profile == "Immersive")
    return {{"Core", 2},      {"Time", 1},          {"Networking", 3}, {"Grouping", 2},
            {"Rendering", 3}, {"Shape", 2},         {"Geometry3D", 4}, {"Lighting", 2},
            {"Texturing", 3}, {"Interpolation", 2}, {"Navigation", 2}, {"EnvironmentalEffects", 2}};
  std::map<std::string, int, std::less<>> all;
  for (const NodeKind& node : nodeKinds()) all[node.component] = 5;
  return all;
}

}  // namespace cloudgen::check
