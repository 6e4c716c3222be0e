// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/tile_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/gzip.hpp"
#include "shape/blending.hpp"
#include "writer/gltf/splat_columns.hpp"
#include "writer/tiles3d/narrow.hpp"
#include "writer/tiles3d/tile_cards.hpp"
#include "writer/tiles3d/tile_splats.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

/// Where viewers cut a splat off.
constexpr float kReach = 3;

/// The puffs that are drawn as splats: those that are seen, as wide as they are drawn, and for CesiumJS
/// narrow.
std::vector<LitPuff> asSplats(const std::vector<LitPuff>& puffs, bool narrow) {
  constexpr std::size_t kMostPieces = 2'000'000;
  std::size_t pieces = 0;
  for (std::size_t i = 0; narrow && i < puffs.size() && pieces <= kMostPieces; ++i)
    pieces += narrowCount(shape::widenedAcross(puffs[i].puff, puffs[i].covering));
  if (pieces > kMostPieces)
    throw base::OutputError("--tiles spz", "would split the clouds of a tile into millions of splats: they are too wide",
                            "take --tiles cards, or auto");
  std::vector<LitPuff> out;
  for (LitPuff lit : puffs) {
    lit.puff = shape::widenedAcross(lit.puff, lit.covering);
    if (gltf::splatOpacity(lit.puff) < gltf::kLeastOpacity) continue;
    if (narrow)
      appendNarrow(lit, out);
    else
      out.push_back(std::move(lit));
  }
  return out;
}

/// How far from its centre what is drawn of a puff reaches, along the axes of the scene.
glm::dvec3 reachOf(const shape::Puff& puff, TileContent content) {
  if (content != TileContent::Cards) {
    const shape::Bounds box = shape::boundsOf(std::span(&puff, 1), kReach);
    return 0.5 * glm::dvec3(box.upper - box.lower);
  }
  glm::vec3 reach(0);
  for (const gltf::Card& card : tileCardsOf(puff))
    reach = glm::max(reach, glm::abs(card.right) + glm::abs(card.up));
  return reach;
}

/// The puffs on the globe; takes what they reach into the region.
std::vector<PlacedPuff> placedPuffs(std::vector<LitPuff> puffs, const Placement& placement,
                                    TileContent content, Region& region) {
  std::vector<PlacedPuff> out;
  for (LitPuff& lit : puffs) {
    const glm::dvec3 reach = reachOf(lit.puff, content), geographic = placement.geographic(lit.puff.center);
    region.include(geographic, std::hypot(reach.x, reach.z), reach.y);
    out.push_back({std::move(lit), geographic});
  }
  return out;
}

void takeRecords(const scene::Scene& scene, Clouds clouds, WrittenTile& written) {
  written.lowestBaseMeters = 1e30, written.highestTopMeters = -1e30;
  for (const std::uint32_t cloud : clouds) {
    const scene::CloudRecord& record = scene.clouds[cloud];
    written.genera.insert(record.genus);
    written.lowestBaseMeters = std::min<double>(written.lowestBaseMeters, record.baseMeters);
    written.highestTopMeters = std::max<double>(written.highestTopMeters, record.topMeters);
  }
}

}  // namespace

std::vector<std::string> extensionsOf(TileContent content) {
  if (content == TileContent::Cards) return {"KHR_materials_unlit"};
  if (content == TileContent::Splats) return {gltf::kSplatting};
  return {gltf::kSplatting, kPackedExtension};
}

TileContent chosenContent(const scene::Scene& scene, const TileTree& tree) {
  constexpr std::size_t kMostTimes = 2;
  const auto found = std::ranges::find(tree.nodes, 0, &TileNode::coarser);
  if (found == tree.nodes.end()) return TileContent::Packed;
  const TileNode& root = *found;
  const auto puffs = puffsAt(scene, tree.cloudsOf(root), root.detail);
  std::size_t pieces = 0;
  for (const LitPuff& lit : puffs) pieces += narrowCount(shape::widenedAcross(lit.puff, lit.covering));
  return pieces <= kMostTimes * puffs.size() ? TileContent::Packed : TileContent::Cards;
}

WrittenTile writeTile(const scene::Scene& scene, const TileTree& tree, const TileNode& node,
                      const TileStyle& style, const std::filesystem::path& file) {
  const Placement placement(scene.frame.box());
  const Clouds clouds = tree.cloudsOf(node);
  WrittenTile written;
  takeRecords(scene, clouds, written);
  auto drawn = puffsAt(scene, clouds, node.detail);
  if (style.content != TileContent::Cards) drawn = asSplats(drawn, style.content == TileContent::Packed);
  const auto puffs = placedPuffs(std::move(drawn), placement, style.content, written.region);
  if (puffs.empty()) return written;
  written.plane = placement.planeAt(written.region.center());
  light::Sun sun = scene.sun;
  sun.direction = placement.turn(written.plane, placement.scene(written.plane.middle)) * sun.direction;
  gltf::GlbFile glb(nlohmann::json{{"tile", node.name()}, {"clouds", clouds.size()}});
  for (const std::string& extension : extensionsOf(style.content))
    glb.useExtension(extension, style.content == TileContent::Packed);
  const std::string name = "tile " + node.name();
  std::vector<gltf::Splat> splats;
  if (style.content == TileContent::Cards) {
    written.drawn = addCards(glb, written.plane, placement, puffs, style.atlases);
  } else {
    splats = splatsOn(written.plane, placement, puffs, sun);
    written.drawn = splats.size();
    if (style.content == TileContent::Splats)
      addPlainSplats(glb, name, splats, sun.direction, style.degree);
    else
      addPackedSplats(glb, name, splats, sun.direction, style.degree);
  }
  glb.write(file);
  if (style.gzip) base::writeFile(file, base::gzipped(base::readFile(file)));
  return written;
}

}  // namespace cloudgen::writer::tiles3d
