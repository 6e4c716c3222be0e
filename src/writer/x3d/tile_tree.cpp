// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/tile_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <set>

namespace cloudgen::writer {
namespace {

constexpr std::size_t kLeafClouds = 24;
/// Puffs of a tile, about: X_ITE reads some 300,000 numbers a second, or 6,000 puffs, while it draws nothing.
constexpr std::size_t kTilePuffs = 6000;

/// XML names and VRML ids hold no minus sign in every viewer.
std::string signedName(int value) { return fmt::format("{}{}", value < 0 ? "m" : "", std::abs(value)); }

class Division {
 public:
  Division(const scene::Scene& scene, float leastSide) : scene_(scene), leastSide_(leastSide) {}

  TileNode node(std::string name, const glm::vec2& corner, float side,
                std::vector<std::uint32_t> instances) const {
    TileNode tile{std::move(name), side, glm::vec3(1e30f), glm::vec3(-1e30f), std::move(instances), {}};
    for (const std::uint32_t i : tile.instances) {
      const shape::Bounds box = scene::boundsOf(scene_, scene_.instances[i]);
      tile.lower = glm::min(tile.lower, box.lower);
      tile.upper = glm::max(tile.upper, box.upper);
    }
    if (tile.instances.size() > kLeafClouds && 0.5f * side >= leastSide_)
      eachQuarter(tile.name, corner, side, tile.instances, [&](auto&&... quarter) {
        tile.children.push_back(node(std::forward<decltype(quarter)>(quarter)...));
      });
    return tile;
  }

  /// The square itself, or squares within it of fewer puffs.
  void squares(std::string name, const glm::vec2& corner, float side, std::vector<std::uint32_t> instances,
               std::vector<TileNode>& out) const {
    if (side < leastSide_ || puffsToRead(scene_, instances) <= kTilePuffs)
      out.push_back(node(std::move(name), corner, side, std::move(instances)));
    else
      eachQuarter(name, corner, side, instances,
                  [&](auto&&... quarter) { squares(std::forward<decltype(quarter)>(quarter)..., out); });
  }

 private:
  template <class Visit>
  void eachQuarter(const std::string& name, const glm::vec2& corner, float side,
                   const std::vector<std::uint32_t>& instances, const Visit& visit) const {
    const float half = 0.5f * side;
    std::array<std::vector<std::uint32_t>, 4> quarters;
    for (const std::uint32_t i : instances) {
      const glm::vec3& place = scene_.instances[i].position;
      quarters[(place.x >= corner.x + half ? 1u : 0u) + (place.z >= corner.y + half ? 2u : 0u)].push_back(i);
    }
    for (std::size_t q = 0; q < 4; ++q)
      if (!quarters[q].empty())
        visit(fmt::format("{}_{}", name, q), corner + half * glm::vec2(q % 2, q / 2), half,
              std::move(quarters[q]));
  }

  const scene::Scene& scene_;
  float leastSide_;
};

}  // namespace

std::size_t puffsToRead(const scene::Scene& scene, std::span<const std::uint32_t> instances) {
  constexpr std::size_t kOfUse = 3;
  std::set<std::uint32_t> known;
  std::size_t puffs = kOfUse * instances.size();
  for (const std::uint32_t i : instances) {
    const std::uint32_t lit = scene.instances[i].lit;
    if (known.insert(lit).second) puffs += scene.archetypes[scene.lit[lit].archetype].puffs.size();
  }
  return puffs;
}

std::vector<TileNode> tileTrees(const scene::Scene& scene, const Stage& stage) {
  constexpr float kLeastSide = 500;
  const Division division(scene, std::max(kLeastSide, stage.cloudWidth));
  const float side = tileSide(stage);
  std::vector<TileNode> trees;
  for (scene::Tile& tile : scene::tilesOf(scene, side))
    division.squares(fmt::format("{}_{}", signedName(tile.column), signedName(tile.row)),
                     side * glm::vec2(tile.column, tile.row), side, std::move(tile.instances), trees);
  return trees;
}

}  // namespace cloudgen::writer
