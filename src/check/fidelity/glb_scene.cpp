// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/file.hpp"
#include "check/fidelity/card_scene.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/gltf/glb_parts.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr std::size_t kMostCards = 10'000'000;
constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// What a mesh draws: cards in its own axes, and whose sprites they carry.
struct CloudMesh {
  std::vector<Card> cards;
  std::optional<base::Genus> drawn;
};

/// Where an instance of a mesh stands.
struct Place {
  glm::vec3 shift{0};
  glm::mat3 axes{1};
};

/// The columns of a primitive.
struct MeshColumns {
  std::vector<float> points, places, colors;  ///< xyz, uv with v downwards, RGBA
  std::vector<std::uint32_t> triangles;

  glm::vec3 point(std::uint32_t vertex) const {
    return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
  }
};

/// Vertices that triangles join are of one card. Gives each vertex the first vertex of its card.
std::vector<std::uint32_t> firstOfCard(const MeshColumns& mesh) {
  std::vector<std::uint32_t> first(mesh.points.size() / 3);
  std::iota(first.begin(), first.end(), 0u);
  const auto find = [&](std::uint32_t vertex) {
    while (first[vertex] != vertex) vertex = first[vertex] = first[first[vertex]];
    return vertex;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t a = find(mesh.triangles[t - t % 3]), b = find(mesh.triangles[t]);
    first[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t vertex = 0; vertex < first.size(); ++vertex) first[vertex] = find(vertex);
  return first;
}

/// The card of some vertices, by the corners of their texture; its alpha is their mean.
Card cardOf(const MeshColumns& mesh, std::span<const std::uint32_t> vertices) {
  // The vertex that lies farthest to a corner: the sum of u and v with a sign each.
  const auto corner = [&](float alongU, float alongV) {
    const auto farness = [&](std::uint32_t v) {
      return alongU * mesh.places[2 * v] + alongV * mesh.places[2 * v + 1];
    };
    return mesh.point(*std::ranges::max_element(vertices, {}, farness));
  };
  const glm::vec3 lowerLeft = corner(-1, 1), lowerRight = corner(1, 1), upperLeft = corner(-1, -1);
  Card card;
  card.center = 0.5f * (lowerRight + upperLeft);
  card.right = 0.5f * (lowerRight - lowerLeft);
  card.up = 0.5f * (upperLeft - lowerLeft);
  for (const std::uint32_t vertex : vertices)
    card.alpha += mesh.colors[4 * vertex + 3] / static_cast<float>(vertices.size());
  return card;
}

/// Adds the cards of a mesh; without both sides they show those that their triangles turn to.
void addCards(const MeshColumns& mesh, bool doubleSided, std::vector<Card>& cards) {
  const auto first = firstOfCard(mesh);
  std::vector<std::uint32_t> order(first.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t vertex) { return first[vertex]; });
  std::vector<std::size_t> cardAt(first.size(), 0);
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() && first[order[to]] == first[order[from]]) ++to;
    cardAt[first[order[from]]] = cards.size();
    cards.push_back(cardOf(mesh, std::span(order).subspan(from, to - from)));
    cards.back().front = cards.back().back = doubleSided;
  }
  for (std::size_t t = 0; !doubleSided && t < mesh.triangles.size(); t += 3) {
    Card& card = cards[cardAt[first[mesh.triangles[t]]]];
    const glm::vec3 corner = mesh.point(mesh.triangles[t]);
    const glm::vec3 normal =
        glm::cross(mesh.point(mesh.triangles[t + 1]) - corner, mesh.point(mesh.triangles[t + 2]) - corner);
    (glm::dot(normal, glm::cross(card.right, card.up)) > 0 ? card.front : card.back) = true;
  }
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where, WrittenScene& scene)
      : glb_(bytes, where, "name a scene.glb that cloudgen wrote, or its folder"), scene_(scene) {}

  void read() {
    try {
      for (const json& node : glb_.root().value("nodes", json::array())) addNode(node);
    } catch (const json::exception& error) {
      glb_.fail(std::string("is no scene of cards (") + error.what() + ")");
    }
  }

 private:
  void addNode(const json& node) {
    if (!node.contains("mesh")) return;
    for (const char* placing : {"matrix", "rotation", "scale", "children"})
      if (node.contains(placing)) glb_.fail("has a cloud whose node is more than translated");
    const CloudMesh mesh = meshOf(node["mesh"]);
    if (!mesh.drawn) return;
    glm::vec3 translation(0);
    if (node.contains("translation"))
      for (int axis = 0; axis < 3; ++axis)
        translation[axis] = node["translation"].at(static_cast<std::size_t>(axis));
    const json extras = node.value("extras", json::object());
    std::optional<base::Genus> recorded;
    if (extras.contains("genus")) recorded = base::genusFromName(extras["genus"].get<std::string>());
    for (const Place& place : placesOf(node)) {
      if (scene_.blobs.size() > kMostCards) glb_.fail("draws more cards than can be read");
      for (const Card& card : mesh.cards) add(card, translation, place);
      scene_.clouds.push_back({translation + place.shift, recorded, mesh.drawn});
    }
  }

  void add(const Card& card, const glm::vec3& translation, const Place& place) {
    Blob blob =
        cardBlob(translation + place.shift + place.axes * card.center, place.axes * card.right / kCardReach,
                 place.axes * card.up / kCardReach, opticalDepthOf(card.alpha));
    blob.front = card.front;
    blob.back = card.back;
    scene_.blobs.push_back(blob);
  }

  std::vector<Place> placesOf(const json& node) const {
    const json extensions = node.value("extensions", json::object());
    if (!extensions.contains(kInstancing)) return {Place{}};
    const json& attributes = extensions[kInstancing].at("attributes");
    const auto column = [&](const char* name, std::size_t components) {
      return attributes.contains(name) ? glb_.floats(attributes[name], components) : std::vector<float>{};
    };
    const auto shifts = column("TRANSLATION", 3), turns = column("ROTATION", 4), scales = column("SCALE", 3);
    const std::size_t count = std::max({shifts.size() / 3, turns.size() / 4, scales.size() / 3});
    for (const auto& [values, components] : {std::pair{&shifts, 3u}, {&turns, 4u}, {&scales, 3u}})
      if (!values->empty() && values->size() != count * components)
        glb_.fail("has instances with columns of different lengths");
    std::vector<Place> places(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!shifts.empty()) places[i].shift = {shifts[3 * i], shifts[3 * i + 1], shifts[3 * i + 2]};
      if (!turns.empty())
        places[i].axes = glm::mat3_cast(
            glm::normalize(glm::quat(turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2])));
      for (int axis = 0; axis < 3 && !scales.empty(); ++axis)
        places[i].axes[axis] *= scales[3 * i + static_cast<std::size_t>(axis)];
    }
    return places;
  }

  /// No sprites: no cloud, but ground.
  CloudMesh meshOf(const json& index) const {
    CloudMesh mesh;
    for (const json& primitive : glb_.root().at("meshes").at(index.get<std::size_t>()).at("primitives")) {
      if (!primitive.contains("material")) continue;
      const json& material = glb_.root().at("materials").at(primitive["material"].get<std::size_t>());
      const auto drawn = genusOf(material);
      if (!drawn) continue;
      mesh.drawn = drawn;
      addCards(columnsOf(primitive), material.value("doubleSided", false), mesh.cards);
    }
    return mesh;
  }

  /// By the name of the picture of its sprites.
  std::optional<base::Genus> genusOf(const json& material) const {
    const json surface = material.value("pbrMetallicRoughness", json::object());
    if (material.value("alphaMode", "") != "BLEND" || !surface.contains("baseColorTexture")) return {};
    const auto texture = surface["baseColorTexture"].at("index").get<std::size_t>();
    const auto image = glb_.root().at("textures").at(texture).at("source").get<std::size_t>();
    return base::genusFromName(glb_.root().at("images").at(image).value("name", ""));
  }

  MeshColumns columnsOf(const json& primitive) const {
    const json& attributes = primitive.at("attributes");
    MeshColumns mesh{glb_.floats(attributes.at("POSITION"), 3), glb_.floats(attributes.at("TEXCOORD_0"), 2),
                     glb_.floats(attributes.at("COLOR_0"), 4), glb_.indices(primitive.at("indices"))};
    const std::size_t count = mesh.points.size() / 3;
    if (mesh.places.size() != 2 * count || mesh.colors.size() != 4 * count ||
        mesh.triangles.size() % 3 != 0 ||
        std::ranges::any_of(mesh.triangles, [&](std::uint32_t vertex) { return vertex >= count; }))
      glb_.fail("has a mesh whose columns do not fit together");
    return mesh;
  }

  const GlbParts glb_;
  WrittenScene& scene_;
};

}  // namespace

WrittenScene readGlbScene(const std::filesystem::path& file) {
  WrittenScene scene = readGlbScene(base::readFile(file), file.string());
  scene.file = file.filename().string();
  return scene;
}

WrittenScene readGlbScene(std::string_view bytes, const std::string& where) {
  WrittenScene scene{where, "glb", {}, {}, {}, 0};
  constexpr float kMostOpaque = 1 - 0.5f / 65535;  // opacities are whole shares of 65535
  Reader(bytes, where, scene).read();
  boundSaturated(scene, kMostOpaque);
  return scene;
}

}  // namespace cloudgen::check
