// SPDX-License-Identifier: Apache-2.0
#include "check/rules/node_table.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace cloudgen::check {
namespace {

struct Row {
  std::string_view name, component;
  int level, version;
  std::string_view role, container;
  /// "type name[=role][!access]" separated by commas; access: i(nitialize only), >(input only), <(output
  /// only), else both.
  std::string_view fields;
};

constexpr std::string_view kGrouping =
    "MFNode children=child, MFNode addChildren!>, MFNode removeChildren!>, SFVec3f bboxCenter!i, SFVec3f "
    "bboxSize!i, SFBool bboxDisplay, SFBool visible";
constexpr std::string_view kMesh =
    "SFNode color=color, SFNode coord=coord, SFNode texCoord=texCoord, SFNode normal=normal, SFBool ccw!i, "
    "SFBool colorPerVertex!i, SFBool normalPerVertex!i, SFBool solid!i";
constexpr std::string_view kUrl =
    "SFString description, SFBool load, SFTime autoRefresh, SFTime autoRefreshTimeLimit, MFString url";
constexpr std::string_view kBound = "SFBool set_bind!>, SFTime bindTime!<, SFBool isBound!<";
constexpr std::string_view kLerp = "SFFloat set_fraction!>, MFFloat key";
constexpr std::string_view kMeta = "SFString name, SFString reference";

constexpr std::array<Row, 40> kRows{{
    {"Group", "Grouping", 1, 20, "child", "children", kGrouping},
    {"StaticGroup", "Grouping", 3, 30, "child", "children",
     "MFNode children=child!i, SFVec3f bboxCenter!i, SFVec3f bboxSize!i, SFBool bboxDisplay, SFBool visible"},
    {"Transform", "Grouping", 1, 20, "child", "children",
     "+grouping, SFVec3f center, SFRotation rotation, SFVec3f scale, SFRotation scaleOrientation, SFVec3f "
     "translation"},
    {"Switch", "Grouping", 2, 20, "child", "children", "+grouping, SFInt32 whichChoice"},
    {"Billboard", "Navigation", 2, 20, "child", "children", "+grouping, SFVec3f axisOfRotation"},
    {"LOD", "Navigation", 2, 20, "child", "children",
     "+grouping, SFVec3f center!i, SFBool forceTransitions!i, MFFloat range!i, SFInt32 level_changed!<"},
    {"Inline", "Networking", 2, 20, "child", "children",
     "+url, SFBool global!i, SFVec3f bboxCenter!i, SFVec3f bboxSize!i, SFBool bboxDisplay, SFBool visible"},
    {"WorldInfo", "Core", 1, 20, "child", "children", "MFString info, SFString title"},
    {"NavigationInfo", "Navigation", 1, 20, "child", "children",
     "+bound, MFFloat avatarSize, SFBool headlight, SFFloat speed, SFTime transitionTime, MFString "
     "transitionType, MFString type, SFFloat visibilityLimit, SFBool transitionComplete!<"},
    {"Background", "EnvironmentalEffects", 1, 20, "child", "children",
     "+bound, MFFloat groundAngle, MFColor groundColor, MFFloat skyAngle, MFColor skyColor, SFFloat "
     "transparency, MFString backUrl, MFString bottomUrl, MFString frontUrl, MFString leftUrl, MFString "
     "rightUrl, MFString topUrl"},
    {"Fog", "EnvironmentalEffects", 2, 20, "child", "children",
     "+bound, SFColor color, SFString fogType, SFFloat visibilityRange"},
    {"Viewpoint", "Navigation", 1, 20, "child", "children",
     "+bound, SFVec3f centerOfRotation, SFString description, SFFloat farDistance, SFFloat fieldOfView, "
     "SFBool jump, SFFloat nearDistance, SFRotation orientation, SFVec3f position, SFBool retainUserOffsets, "
     "SFBool viewAll"},
    {"DirectionalLight", "Lighting", 1, 20, "child", "children",
     "SFFloat ambientIntensity, SFColor color, SFVec3f direction, SFBool global, SFFloat intensity, SFBool "
     "on, SFFloat shadowIntensity, SFBool shadows"},
    {"Shape", "Shape", 1, 20, "child", "children",
     "SFNode appearance=appearance, SFNode geometry=geometry, SFVec3f bboxCenter!i, SFVec3f bboxSize!i, "
     "SFBool bboxDisplay, SFBool visible, SFBool castShadow"},
    {"Appearance", "Shape", 1, 20, "appearance", "appearance",
     "SFNode material=material, SFNode texture=texture, SFNode textureTransform=textureTransform, SFFloat "
     "alphaCutoff, SFString alphaMode"},
    {"Material", "Shape", 1, 20, "material", "material",
     "SFFloat ambientIntensity, SFColor diffuseColor, SFColor emissiveColor, SFFloat shininess, SFColor "
     "specularColor, SFFloat transparency, SFNode emissiveTexture=texture, SFNode normalTexture=texture, "
     "SFNode occlusionTexture=texture"},
    {"UnlitMaterial", "Shape", 1, 40, "material", "material",
     "SFColor emissiveColor, SFFloat transparency, SFNode emissiveTexture=texture, SFNode "
     "normalTexture=texture"},
    {"ImageTexture", "Texturing", 1, 20, "texture", "texture",
     "+url, SFBool repeatS!i, SFBool repeatT!i, SFNode textureProperties=textureProperties!i"},
    {"TextureProperties", "Texturing", 2, 32, "textureProperties", "textureProperties",
     "SFFloat anisotropicDegree, SFColorRGBA borderColor, SFInt32 borderWidth, SFString boundaryModeR, "
     "SFString boundaryModeS, SFString boundaryModeT, SFBool generateMipMaps!i, SFString "
     "magnificationFilter, SFString minificationFilter, SFString textureCompression, SFFloat "
     "texturePriority"},
    {"TextureTransform", "Texturing", 1, 20, "textureTransform", "textureTransform",
     "SFVec2f center, SFString mapping, SFFloat rotation, SFVec2f scale, SFVec2f translation"},
    {"IndexedTriangleSet", "Rendering", 3, 30, "geometry", "geometry",
     "+mesh, MFInt32 index!i, MFInt32 set_index!>"},
    {"ElevationGrid", "Geometry3D", 3, 20, "geometry", "geometry",
     "SFNode color=color, SFNode texCoord=texCoord, SFNode normal=normal, MFFloat set_height!>, MFFloat "
     "height!i, SFBool ccw!i, SFBool colorPerVertex!i, SFFloat creaseAngle!i, SFBool normalPerVertex!i, "
     "SFBool solid!i, SFInt32 xDimension!i, SFFloat xSpacing!i, SFInt32 zDimension!i, SFFloat zSpacing!i"},
    {"IndexedFaceSet", "Geometry3D", 2, 20, "geometry", "geometry",
     "+mesh, MFInt32 colorIndex!i, SFBool convex!i, MFInt32 coordIndex!i, SFFloat creaseAngle!i, MFInt32 "
     "normalIndex!i, MFInt32 texCoordIndex!i, MFInt32 set_colorIndex!>, MFInt32 set_coordIndex!>, MFInt32 "
     "set_normalIndex!>, MFInt32 set_texCoordIndex!>"},
    {"IndexedLineSet", "Rendering", 1, 20, "geometry", "geometry",
     "SFNode color=color, SFNode coord=coord, MFInt32 colorIndex!i, SFBool colorPerVertex!i, MFInt32 "
     "coordIndex!i, MFInt32 set_colorIndex!>, MFInt32 set_coordIndex!>"},
    {"Coordinate", "Rendering", 1, 20, "coord", "coord", "MFVec3f point"},
    {"TextureCoordinate", "Texturing", 1, 20, "texCoord", "texCoord", "SFString mapping, MFVec2f point"},
    {"Color", "Rendering", 1, 20, "color", "color", "MFColor color"},
    {"ColorRGBA", "Rendering", 1, 30, "color", "color", "MFColorRGBA color"},
    {"TimeSensor", "Time", 1, 20, "child", "children",
     "SFTime cycleInterval, SFString description, SFBool enabled, SFBool loop, SFTime pauseTime, SFTime "
     "resumeTime, SFTime startTime, SFTime stopTime, SFTime cycleTime!<, SFTime elapsedTime!<, SFFloat "
     "fraction_changed!<, SFBool isActive!<, SFBool isPaused!<, SFTime time!<"},
    {"PositionInterpolator", "Interpolation", 1, 20, "child", "children",
     "+lerp, MFVec3f keyValue, SFVec3f value_changed!<"},
    {"OrientationInterpolator", "Interpolation", 1, 20, "child", "children",
     "+lerp, MFRotation keyValue, SFRotation value_changed!<"},
    {"ScalarInterpolator", "Interpolation", 1, 20, "child", "children",
     "+lerp, MFFloat keyValue, SFFloat value_changed!<"},
    {"CoordinateInterpolator", "Interpolation", 1, 20, "child", "children",
     "+lerp, MFVec3f keyValue, MFVec3f value_changed!<"},
    {"ColorInterpolator", "Interpolation", 2, 20, "child", "children",
     "+lerp, MFColor keyValue, SFColor value_changed!<"},
    {"MetadataSet", "Core", 1, 30, "metadata", "metadata", "+meta, MFNode value=metadata"},
    {"MetadataString", "Core", 1, 30, "metadata", "metadata", "+meta, MFString value"},
    {"MetadataDouble", "Core", 1, 30, "metadata", "metadata", "+meta, MFDouble value"},
    {"MetadataFloat", "Core", 1, 30, "metadata", "metadata", "+meta, MFFloat value"},
    {"MetadataInteger", "Core", 1, 30, "metadata", "metadata", "+meta, MFInt32 value"},
    {"MetadataBoolean", "Core", 1, 33, "metadata", "metadata", "+meta, MFBool value"},
}};

std::string_view shared(std::string_view name) {
  if (name == "+grouping") return kGrouping;
  if (name == "+mesh") return kMesh;
  if (name == "+url") return kUrl;
  if (name == "+bound") return kBound;
  if (name == "+lerp") return kLerp;
  return kMeta;
}

Access accessOf(char letter) {
  switch (letter) {
    case 'i':
      return Access::InitializeOnly;
    case '>':
      return Access::InputOnly;
    case '<':
      return Access::OutputOnly;
    default:
      return Access::InputOutput;
  }
}

void appendFields(std::vector<FieldKind>& fields, std::string_view text) {
  while (!text.empty()) {
    std::string_view entry = text.substr(0, text.find(", "));
    text.remove_prefix(std::min(text.size(), entry.size() + 2));
    if (entry.front() == '+') {
      appendFields(fields, shared(entry));
      continue;
    }
    FieldKind field;
    field.access = Access::InputOutput;
    if (const auto mark = entry.find('!'); mark != entry.npos)
      field.access = accessOf(entry[mark + 1]), entry = entry.substr(0, mark);
    if (const auto role = entry.find('='); role != entry.npos)
      field.accepts = entry.substr(role + 1), entry = entry.substr(0, role);
    field.type = entry.substr(0, entry.find(' '));
    field.name = entry.substr(entry.find(' ') + 1);
    fields.push_back(std::move(field));
  }
}

NodeKind nodeFrom(const Row& row) {
  NodeKind node{std::string(row.name), std::string(row.component), row.level, row.version,
                std::string(row.role), std::string(row.container), {}};
  appendFields(node.fields, row.fields);
  node.fields.push_back({"metadata", "SFNode", Access::InputOutput, "metadata"});
  return node;
}

}  // namespace

const FieldKind* NodeKind::field(std::string_view wanted) const {
  for (const FieldKind& candidate : fields)
    if (candidate.name == wanted) return &candidate;
  return nullptr;
}

std::span<const NodeKind> nodeKinds() {
  static const std::vector<NodeKind> nodes = [] {
    std::vector<NodeKind> all;
    for (const Row& row : kRows) all.push_back(nodeFrom(row));
    return all;
  }();
  return nodes;
}

const NodeKind* nodeKind(std::string_view name) {
  static const auto byName = [] {
    std::map<std::string_view, const NodeKind*> index;
    for (const NodeKind& node : nodeKinds()) index.emplace(node.name, &node);
    return index;
  }();
  const auto found = byName.find(name);
  return found == byName.end() ? nullptr : found->second;
}

int tupleSize(std::string_view type) {
  const std::string_view value = type.substr(2);
  if (value == "Float" || value == "Double" || value == "Time" || value == "Int32") return 1;
  if (value == "Vec2f") return 2;
  if (value == "Vec3f" || value == "Color") return 3;
  if (value == "Rotation" || value == "ColorRGBA") return 4;
  return 0;
}

}  // namespace cloudgen::check
