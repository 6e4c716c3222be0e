// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/tile_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::writer {
namespace {

constexpr std::size_t kLeafClouds = 8;
constexpr float kMostAcross = 4, kLeastSide = 500;
constexpr int kMostDepth = 7;
/// How many times its own side away a square is seen as a whole. From there its clouds are seen from about
/// the same side, and a texel of their pictures is two pixels of a screen of 720 lines.
constexpr float kRangeSides = 1.6f;

/// XML names and VRML ids hold no minus sign in every viewer.
std::string signedName(int value) { return fmt::format("{}{}", value < 0 ? "m" : "", std::abs(value)); }

class Division {
 public:
  Division(const scene::Scene& scene, float leastSide) : scene_(scene), leastSide_(leastSide) {}

  TileNode node(std::string name, const glm::vec2& corner, float side, std::vector<std::uint32_t> instances,
                int depth) const {
    TileNode tile{std::move(name)};
    tile.lower = glm::vec3(1e30f);
    tile.upper = glm::vec3(-1e30f);
    for (const std::uint32_t i : instances) {
      const shape::Bounds box = scene::boundsOf(scene_, scene_.instances[i]);
      tile.lower = glm::min(tile.lower, box.lower);
      tile.upper = glm::max(tile.upper, box.upper);
    }
    const glm::vec3 size = tile.upper - tile.lower;
    tile.range = kRangeSides * std::max({side, 0.6f * size.x, 0.6f * size.z});
    tile.instances = std::move(instances);
    if (tile.instances.size() <= kLeafClouds || 0.5f * side < leastSide_ || depth == kMostDepth) return tile;

    const float half = 0.5f * side;
    std::array<std::vector<std::uint32_t>, 4> quarters;
    for (const std::uint32_t i : tile.instances) {
      const glm::vec3& place = scene_.instances[i].position;
      const std::size_t east = place.x >= corner.x + half ? 1 : 0, south = place.z >= corner.y + half ? 2 : 0;
      quarters[east + south].push_back(i);
    }
    for (std::size_t q = 0; q < 4; ++q)
      if (!quarters[q].empty())
        tile.children.push_back(node(fmt::format("{}_{}", tile.name, q),
                                     corner + half * glm::vec2(q % 2, q / 2), half, std::move(quarters[q]),
                                     depth + 1));
    return tile;
  }

 private:
  const scene::Scene& scene_;
  float leastSide_;
};

/// Clouds in full that a viewer at a place has loaded.
std::size_t cloudsLoadedAt(const glm::vec3& place, const std::vector<TileNode>& tiles) {
  std::size_t clouds = 0;
  for (const TileNode& tile : tiles) {
    const glm::vec3 away = glm::abs(place - tile.middle());
    if (std::max({away.x, away.y, away.z}) > kLoadAhead * tile.range) continue;
    clouds += tile.children.empty() ? tile.instances.size() : cloudsLoadedAt(place, tile.children);
  }
  return clouds;
}

void scaleRanges(std::vector<TileNode>& tiles, float by) {
  for (TileNode& tile : tiles) {
    tile.range *= by;
    scaleRanges(tile.children, by);
  }
}

/// Clouds that are drawn wider than natural reach far into their neighbours: tiles are then loaded from
/// nearer by, so that no more of them stand in full about the focus than viewers draw.
void keepLoadable(std::vector<TileNode>& tiles, const glm::vec3& focus) {
  constexpr std::size_t kMostLoaded = 1200;
  constexpr float kNearer = 0.8f;
  for (int step = 0; step < 12 && cloudsLoadedAt(focus, tiles) > kMostLoaded; ++step)
    scaleRanges(tiles, kNearer);
}

}  // namespace

std::vector<TileNode> tileTrees(const scene::Scene& scene, const Stage& stage) {
  const float leastSide = std::max(kLeastSide, stage.cloudWidth);
  const auto clouds = static_cast<float>(scene.instances.size());
  const float across = std::clamp(std::ceil(std::sqrt(clouds / kLeafClouds)), 1.0f, kMostAcross);
  const float side = std::max(1.001f * stage.extent / across, leastSide);
  const Division division(scene, leastSide);
  std::vector<TileNode> trees;
  for (scene::Tile& tile : scene::tilesOf(scene, side)) {
    const glm::vec2 corner = side * glm::vec2(tile.column, tile.row);
    trees.push_back(division.node(fmt::format("{}_{}", signedName(tile.column), signedName(tile.row)), corner,
                                  side, std::move(tile.instances), 0));
  }
  keepLoadable(trees, stage.focus);
  return trees;
}

}  // namespace cloudgen::writer
