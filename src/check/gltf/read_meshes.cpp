// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/read_meshes.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "check/gltf/film_pose.hpp"
#include "check/gltf/glb_parts.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// Where a node stands by its translation, rotation and scale.
MeshPlace placeOf(const json& node) {
  const auto part = [&](const char* key, std::size_t i, float usual) {
    return node.contains(key) ? node[key].at(i).get<float>() : usual;
  };
  MeshPlace place;
  place.shift = {part("translation", 0, 0), part("translation", 1, 0), part("translation", 2, 0)};
  const glm::quat turn(part("rotation", 3, 1), part("rotation", 0, 0), part("rotation", 1, 0),
                       part("rotation", 2, 0));
  place.axes = glm::mat3_cast(glm::normalize(turn));
  for (int axis = 0; axis < 3; ++axis)
    place.axes[axis] *= part("scale", static_cast<std::size_t>(axis), 1);
  return place;
}

std::vector<MeshPlace> placesOf(const GlbParts& glb, const json& node) {
  const MeshPlace own = placeOf(node);
  const json extensions = node.value("extensions", json::object());
  if (!extensions.contains(kInstancing)) return {own};
  const json& attributes = extensions[kInstancing].at("attributes");
  const auto column = [&](const char* name, std::size_t components) {
    return attributes.contains(name) ? glb.floats(attributes[name], components) : std::vector<float>{};
  };
  const auto shifts = column("TRANSLATION", 3), turns = column("ROTATION", 4), scales = column("SCALE", 3);
  const std::size_t count = std::max({shifts.size() / 3, turns.size() / 4, scales.size() / 3});
  for (const auto& [values, components] : {std::pair{&shifts, 3u}, {&turns, 4u}, {&scales, 3u}})
    if (!values->empty() && values->size() != count * components)
      glb.fail("has instances with columns of different lengths");
  std::vector<MeshPlace> places;
  for (std::size_t i = 0; i < count; ++i) {
    MeshPlace place;
    if (!shifts.empty()) place.shift += glm::vec3(shifts[3 * i], shifts[3 * i + 1], shifts[3 * i + 2]);
    if (!turns.empty())
      place.axes = glm::mat3_cast(
          glm::normalize(glm::quat(turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2])));
    for (int axis = 0; axis < 3 && !scales.empty(); ++axis)
      place.axes[axis] *= scales[3 * i + static_cast<std::size_t>(axis)];
    places.push_back({own.shift + own.axes * place.shift, own.axes * place.axes});
  }
  return places;
}

/// Nothing where nothing is blended.
std::string pictureOf(const json& root, const json& material) {
  const json surface = material.value("pbrMetallicRoughness", json::object());
  if (material.value("alphaMode", "") != "BLEND" || !surface.contains("baseColorTexture")) return {};
  const auto texture = surface["baseColorTexture"].at("index").get<std::size_t>();
  const auto image = root.at("textures").at(texture).at("source").get<std::size_t>();
  return root.at("images").at(image).value("name", "");
}

/// Pairs of triangles a, b, c and a, c, d.
bool isInCells(const std::vector<std::uint32_t>& triangles) {
  if (triangles.size() % 6 != 0) return false;
  for (std::size_t t = 0; t < triangles.size(); t += 6)
    if (triangles[t + 3] != triangles[t] || triangles[t + 4] != triangles[t + 2]) return false;
  return true;
}

std::vector<PictureMesh> partsOf(const GlbParts& glb, const json& mesh) {
  std::vector<PictureMesh> parts;
  for (const json& primitive : mesh.at("primitives")) {
    if (!primitive.contains("material")) continue;
    const json& material = glb.root().at("materials").at(primitive["material"].get<std::size_t>());
    const std::string picture = pictureOf(glb.root(), material);
    if (picture.empty()) continue;
    const json& attributes = primitive.at("attributes");
    const auto column = [&](const char* name, std::size_t components) {
      return attributes.contains(name) ? glb.floats(attributes[name], components) : std::vector<float>{};
    };
    parts.push_back({glb.floats(attributes.at("POSITION"), 3), glb.floats(attributes.at("TEXCOORD_0"), 2),
                     column("COLOR_0", 4), column("_OPTICAL_DEPTH", 1), column("_VERTICAL_OPTICAL_DEPTH", 1),
                     glb.indices(primitive.at("indices")), material.value("doubleSided", false), picture});
    PictureMesh& part = parts.back();
    if (part.colors.empty()) part.colors.assign(4 * part.vertices(), 1);
    const auto fits = [&](const std::vector<float>& some) { return some.empty() || some.size() == part.vertices(); };
    if (part.places.size() != 2 * part.vertices() || part.colors.size() != 4 * part.vertices() ||
        !fits(part.opticalDepths) || !fits(part.verticalOpticalDepths) || part.triangles.size() % 3 != 0 ||
        (!part.verticalOpticalDepths.empty() && !isInCells(part.triangles)) ||
        std::ranges::any_of(part.triangles, [&](std::uint32_t vertex) { return vertex >= part.vertices(); }))
      glb.fail("has a mesh whose columns do not fit together");
  }
  return parts;
}

/// Nodes that stand for others from afar (MSFT_lod): the same clouds again.
std::set<std::size_t> farLevelsOf(const json& nodes) {
  std::set<std::size_t> levels;
  for (const json& node : nodes) {
    const json extensions = node.value("extensions", json::object());
    if (!extensions.contains("MSFT_lod")) continue;
    for (const json& id : extensions["MSFT_lod"].at("ids")) levels.insert(id.get<std::size_t>());
  }
  return levels;
}

}  // namespace

void readPictureMeshes(std::string_view bytes, const std::string& where,
                       const std::function<void(const MeshNode&)>& visit, double seconds) {
  const GlbParts glb(bytes, where, "name a scene.glb that cloudgen wrote, or its folder");
  try {
    const json nodes = seconds != 0 ? nodesAt(glb, seconds) : glb.root().value("nodes", json::array());
    const auto farLevels = farLevelsOf(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const json& node = nodes[i];
      if (!node.contains("mesh") || farLevels.contains(i)) continue;
      MeshNode read{partsOf(glb, glb.root().at("meshes").at(node["mesh"].get<std::size_t>())), {}, {}};
      if (read.parts.empty()) continue;
      for (const char* placing : {"matrix", "children"})
        if (node.contains(placing)) glb.fail("has a cloud whose node is placed by a matrix, or has children");
      read.places = placesOf(glb, node);
      read.genus = node.value("extras", json::object()).value("genus", "");
      visit(read);
    }
  } catch (const json::exception& error) {
    glb.fail(std::string("is no scene of cards (") + error.what() + ")");
  }
}

}  // namespace cloudgen::check
