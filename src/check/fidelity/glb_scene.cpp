// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/file.hpp"
#include "check/fidelity/card_scene.hpp"
#include "check/fidelity/picture_cards.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/gltf/read_meshes.hpp"

namespace cloudgen::check {
namespace {

constexpr std::size_t kMostCards = 20'000'000;

void addNode(const MeshNode& node, const std::string& where, WrittenScene& scene) {
  std::vector<Card> cards;
  std::optional<base::Genus> drawn;
  for (const PictureMesh& part : node.parts) {
    const auto genus = base::genusFromName(part.picture);
    if (!genus) continue;
    drawn = genus;
    addCardsOf(part, cards);
  }
  if (!drawn) return;
  if (cards.size() > 0 && node.places.size() > (kMostCards - scene.blobs.size()) / cards.size())
    throw base::InputError(where, "draws more cards than can be read", "is it a scene of cloudgen?");
  for (const MeshPlace& place : node.places) {
    if (place.axes == glm::mat3(0)) continue;  // not at this time of a sky that moves
    for (const Card& card : cards) {
      Blob blob = cardBlob(place.shift + place.axes * card.center, place.axes * card.right / kCardReach,
                           place.axes * card.up / kCardReach, card.opticalDepth);
      blob.front = card.front;
      blob.back = card.back;
      scene.blobs.push_back(blob);
    }
    scene.clouds.push_back({place.shift, base::genusFromName(node.genus), drawn});
  }
}

}  // namespace

WrittenScene readGlbScene(const std::filesystem::path& file, double seconds) {
  WrittenScene scene = readGlbScene(base::readFile(file), file.string(), seconds);
  scene.file = file.filename().string();
  return scene;
}

WrittenScene readGlbScene(std::string_view bytes, const std::string& where, double seconds) {
  constexpr float kMostOpaque = 1 - 0.5f / 65535;  // opacities are whole shares of 65535
  WrittenScene scene{where, "glb", {}, {}, {}, 0};
  readPictureMeshes(bytes, where, [&](const MeshNode& node) { addNode(node, where, scene); }, seconds);
  boundSaturated(scene, kMostOpaque);
  return scene;
}

}  // namespace cloudgen::check
