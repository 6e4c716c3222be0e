// SPDX-License-Identifier: Apache-2.0
#include "check/rules/profiles.hpp"

#include "check/rules/node_table.hpp"

namespace cloudgen::check {

std::map<std::string, int, std::less<>> componentsOf(std::string_view profile) {
  if (profile == "Core") return {{"Core", 1}};
  if (profile == "Interchange")
    return {{"Core", 1},      {"Time", 1},          {"Networking", 1}, {"Grouping", 1},
            {"Rendering", 3}, {"Shape", 1},         {"Geometry3D", 2}, {"Lighting", 1},
            {"Texturing", 2}, {"Interpolation", 2}, {"Navigation", 1}, {"EnvironmentalEffects", 1}};
  if (profile == "CADInterchange")
    return {{"Core", 1},     {"Networking", 2}, {"Grouping", 1},   {"Rendering", 4}, {"Shape", 2},
            {"Lighting", 1}, {"Texturing", 2},  {"Navigation", 2}, {"Shaders", 1},   {"CADGeometry", 2}};
  if (profile == "MedicalInterchange")
    return {{"Core", 1},           {"Time", 1},
            {"Networking", 2},     {"Grouping", 3},
            {"Rendering", 5},      {"Shape", 3},
            {"Geometry3D", 2},     {"Geometry2D", 2},
            {"Text", 1},           {"Lighting", 1},
            {"Texturing", 2},      {"Interpolation", 2},
            {"Navigation", 3},     {"EnvironmentalEffects", 1},
            {"EventUtilities", 1}, {"Texturing3D", 2},
            {"VolumeRendering", 4}};
  if (profile == "MPEG4Interactive")
    return {{"Core", 1},
            {"Time", 1},
            {"Networking", 2},
            {"Grouping", 2},
            {"Rendering", 1},
            {"Shape", 1},
            {"Geometry3D", 2},
            {"Lighting", 2},
            {"Texturing", 1},
            {"Interpolation", 2},
            {"PointingDeviceSensor", 1},
            {"EnvironmentalSensor", 1},
            {"Navigation", 1},
            {"EnvironmentalEffects", 1}};
  if (profile == "Interactive")
    return {{"Core", 1},
            {"Time", 1},
            {"Networking", 2},
            {"Grouping", 2},
            {"Rendering", 3},
            {"Shape", 1},
            {"Geometry3D", 3},
            {"Lighting", 2},
            {"Texturing", 2},
            {"Interpolation", 2},
            {"PointingDeviceSensor", 1},
            {"KeyDeviceSensor", 1},
            {"EnvironmentalSensor", 1},
            {"Navigation", 1},
            {"EnvironmentalEffects", 1},
            {"EventUtilities", 1}};
  if (profile == "Immersive")
    return {{"Core", 2},
            {"Time", 1},
            {"Networking", 3},
            {"Grouping", 2},
            {"Rendering", 3},
            {"Shape", 2},
            {"Geometry3D", 4},
            {"Geometry2D", 1},
            {"Text", 1},
            {"Sound", 1},
            {"Lighting", 2},
            {"Texturing", 3},
            {"Interpolation", 2},
            {"PointingDeviceSensor", 1},
            {"KeyDeviceSensor", 2},
            {"EnvironmentalSensor", 2},
            {"Navigation", 2},
            {"EnvironmentalEffects", 2},
            {"Scripting", 1},
            {"EventUtilities", 1}};
  constexpr int kHighestLevel = 9;
  std::map<std::string, int, std::less<>> all;
  for (const NodeKind& node : nodeKinds()) all[node.component] = kHighestLevel;
  return all;
}

}  // namespace cloudgen::check
