// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_cards.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace cloudgen::writer::tiles3d {
namespace {

constexpr float kFaintest = 0.004f;   ///< opacity below which an upright card is left out
constexpr float kNarrowest = 0.35f;   ///< area of an upright card, to the lying one, below which it is

/// Appends a card as four vertices and two triangles; `turn` takes the puff's axes to the plane.
void append(gltf::CardMesh& mesh, const gltf::Card& card, const glm::vec3& place, const glm::quat& turn,
            const glm::vec4& box, const glm::vec3& color) {
  const auto first = static_cast<std::uint32_t>(mesh.opticalDepths.size());
  const auto toShort = [](float unit) {
    return static_cast<std::uint16_t>(std::lround(65535.0f * glm::clamp(unit, 0.0f, 1.0f)));
  };
  for (const auto& [u, v] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 1.0f}}) {
    const glm::vec3 corner = place + turn * ((2 * u - 1) * card.right + (2 * v - 1) * card.up);
    mesh.positions.insert(mesh.positions.end(), {corner.x, corner.y, corner.z});
    mesh.textureBoxes.insert(mesh.textureBoxes.end(),
                             {glm::mix(box.x, box.z, u), 1 - glm::mix(box.y, box.w, v)});
    mesh.colors.insert(mesh.colors.end(), {toShort(color.x), toShort(color.y), toShort(color.z),
                                           toShort(-std::expm1(-card.opticalDepth))});
    mesh.opticalDepths.push_back(card.opticalDepth);
  }
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
}

}  // namespace

std::vector<gltf::Card> tileCardsOf(const shape::Puff& puff) {
  const auto areaOf = [](const gltf::Card& card) { return glm::length(glm::cross(card.right, card.up)); };
  const auto all = gltf::cardsOf(puff, 1);
  const auto lying = std::ranges::find(all, false, &gltf::Card::upright);
  std::vector<gltf::Card> cards;
  for (const gltf::Card& card : all)
    if (!card.upright ||
        (-std::expm1(-card.opticalDepth) >= kFaintest && areaOf(card) >= kNarrowest * areaOf(*lying)))
      cards.push_back(card);
  return cards;
}

std::size_t addCards(gltf::GlbFile& file, const TilePlane& plane, const Placement& placement,
                     std::span<const PlacedPuff> puffs, const std::vector<image::SpriteAtlas>& atlases) {
  std::vector<std::size_t> order(puffs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return puffs[i].geographic.z; });
  std::map<base::Genus, gltf::CardMesh> meshes;
  std::size_t count = 0;
  for (const std::size_t i : order) {
    const LitPuff& lit = puffs[i].lit;
    const image::SpriteAtlas& atlas = image::atlasOf(atlases, lit.genus);
    const glm::vec3 place(placement.onPlane(plane, puffs[i].geographic));
    const glm::quat turn = placement.turn(plane, lit.puff.center);
    for (const gltf::Card& card : tileCardsOf(lit.puff)) {
      append(meshes[lit.genus], card, place, turn, atlas.textureBox(lit.puff.sprite % atlas.tiles()),
             lit.light.color);
      ++count;
    }
  }
  for (const auto& [genus, mesh] : meshes) {
    const std::string name(base::abbreviation(genus));
    const int texture = file.addTexture(name, "../textures/" + image::atlasOf(atlases, genus).file);
    const nlohmann::json extras{{"genus", name}};
    const int material = file.addCardMaterial(name, texture);
    file.addNode({.name = name,
                  .mesh = gltf::addCardMesh(file, name, gltf::addCardColumns(file, mesh), mesh, material),
                  .extras = &extras});
  }
  return count;
}

}  // namespace cloudgen::writer::tiles3d
