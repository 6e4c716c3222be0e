// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/color_mesh.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace cloudgen::writer {
namespace {

/// A few hundred metres need no tenths.
int decimalsFor(const ColorMesh& mesh) {
  constexpr float kWide = 300;
  glm::vec3 reach(0);
  for (const glm::vec3& point : mesh.points) reach = glm::max(reach, glm::abs(point));
  return std::max({reach.x, reach.y, reach.z}) > kWide ? 0 : 1;
}

constexpr const char* kUnlit = "Unlit";
constexpr float kOpaque = 0.95f;          ///< opacity of what is drawn without looking through it
constexpr std::size_t kFewestOpaque = 6;  ///< triangles that are worth a Shape of their own

/// Which triangles are opaque at all corners.
std::vector<bool> opaqueOf(const ColorMesh& mesh) {
  std::vector<bool> isOpaque;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    isOpaque.push_back(
        std::all_of(mesh.indices.begin() + static_cast<std::ptrdiff_t>(t),
                    mesh.indices.begin() + static_cast<std::ptrdiff_t>(t) + 3,
                    [&](std::int32_t i) { return mesh.colors[static_cast<std::size_t>(i)].a >= kOpaque; }));
  if (!mesh.mayHide || static_cast<std::size_t>(std::ranges::count(isOpaque, true)) < kFewestOpaque)
    isOpaque.assign(isOpaque.size(), false);
  return isOpaque;
}

/// Those that are not, and those beside them: else a line of what is behind is seen where both Shapes meet.
std::vector<bool> blendedOf(const ColorMesh& mesh, const std::vector<bool>& isOpaque) {
  std::vector<int> isBlended(mesh.points.size(), 0);
  const auto corner = [&](std::size_t i) { return static_cast<std::size_t>(mesh.indices[i]); };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    if (!isOpaque[i / 3]) isBlended[corner(i)] = 1;
  std::vector<bool> out;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    out.push_back(isBlended[corner(t)] + isBlended[corner(t + 1)] + isBlended[corner(t + 2)] >= 2);
  return out;
}

ColorMesh partOf(const ColorMesh& mesh, const std::vector<bool>& isOfPart) {
  ColorMesh part;
  std::vector<std::int32_t> places(mesh.points.size(), -1);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (!isOfPart[i / 3]) continue;
    const auto corner = static_cast<std::size_t>(mesh.indices[i]);
    if (places[corner] < 0) {
      places[corner] = static_cast<std::int32_t>(part.points.size());
      part.points.push_back(mesh.points[corner]);
      part.colors.push_back(mesh.colors[corner]);
    }
    part.indices.push_back(places[corner]);
  }
  return part;
}

/// Colours as they are, unlit. X3DOM 1.8 sorts by distance only what has a translucent Material.
void writeLook(NodeWriter& nodes) {
  if (nodes.encoding() != Encoding::Xml) return;
  nodes.open("Appearance", "appearance");
  nodes.open("ProtoInstance", "material");
  nodes.string("name", kUnlit);
  nodes.close();
  nodes.close();
}

void writeShape(NodeWriter& nodes, const ColorMesh& mesh, const glm::vec3& tint, bool opaque) {
  if (mesh.indices.empty()) return;
  std::vector<float> points, colors;
  for (const glm::vec3& point : mesh.points) points.insert(points.end(), {point.x, point.y, point.z});
  for (const glm::vec4& color : mesh.colors) {
    const glm::vec3 tinted = tint * glm::vec3(color);
    colors.insert(colors.end(), {tinted.r, tinted.g, tinted.b});
    if (!opaque) colors.push_back(color.a);
  }
  nodes.open("Shape");
  if (!opaque) writeLook(nodes);
  nodes.open("IndexedTriangleSet", "geometry");
  nodes.integers("index", mesh.indices);
  nodes.open(opaque ? "Color" : "ColorRGBA", "color");
  nodes.numbers("color", colors, opaque ? 3 : 4, 2);  // between corners there are steps enough
  nodes.close();
  nodes.open("Coordinate", "coord");
  nodes.numbers("point", points, 3, decimalsFor(mesh));
  nodes.close();
  nodes.close();
  nodes.close();
}

}  // namespace

void appendMesh(const CloudPicture& one, const PictureMesh& flat, const glm::vec3& origin, ColorMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const glm::vec2& point : flat.points)
    mesh.points.push_back(point.x * one.sight.right + point.y * one.sight.up +
                          one.picture.surface * one.sight.towards - origin);
  mesh.colors.insert(mesh.colors.end(), flat.colors.begin(), flat.colors.end());
  for (const std::uint32_t index : flat.indices)
    mesh.indices.push_back(first + static_cast<std::int32_t>(index));
}

void declareUnlit(NodeWriter& nodes) {
  if (nodes.encoding() != Encoding::Xml) return;
  nodes.open("ProtoDeclare");
  nodes.string("name", kUnlit);
  nodes.open("ProtoBody");
  nodes.open("UnlitMaterial", "material");
  nodes.close();
  nodes.open("Material", "material");
  nodes.number("transparency", 0.001, 3);
  nodes.close();
  nodes.close();
  nodes.close();
}

void writeMesh(NodeWriter& nodes, const ColorMesh& mesh, const glm::vec3& tint) {
  // What is opaque hides what is behind before that is blended.
  const std::vector<bool> isOpaque = opaqueOf(mesh);
  writeShape(nodes, partOf(mesh, isOpaque), tint, true);
  writeShape(nodes, partOf(mesh, blendedOf(mesh, isOpaque)), tint, false);
}

void writeTurning(NodeWriter& nodes, const glm::vec3& center, const ColorMesh& mesh, const glm::vec3& tint) {
  nodes.open("Transform");
  nodes.vector("translation", center, 1);
  nodes.open("Billboard");
  nodes.vector("axisOfRotation", glm::vec3(0), 0);
  writeMesh(nodes, mesh, tint);
  nodes.close();
  nodes.close();
}

}  // namespace cloudgen::writer
