// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/vrml97_clouds.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "writer/x3d/cloud_record.hpp"
#include "writer/x3d/file_pictures.hpp"
#include "writer/x3d/film_nodes.hpp"
#include "writer/x3d/turning_pictures.hpp"

namespace cloudgen::writer {
namespace {

constexpr std::size_t kTurning = 1000;  ///< clouds with a node of their own, at most, unless they move
constexpr PictureSize kAfar{1.2e6, 128};

/// The clouds nearest to where the viewpoints look; all that move.
std::vector<std::uint32_t> turningOf(const scene::Scene& scene, const Stage& stage, const Film& film) {
  std::vector<std::uint32_t> order(scene.instances.size());
  std::iota(order.begin(), order.end(), 0u);
  if (film.moves() || order.size() <= kTurning) return order;
  const auto away = [&](std::uint32_t i) { return glm::distance(scene.instances[i].position, stage.focus); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return away(a) < away(b); });
  order.resize(kTurning);
  return order;
}

}  // namespace

void writeVrml97Clouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                       const std::filesystem::path& folder, const base::Progress& progress) {
  const Film film(scene);
  const std::vector<std::uint32_t> turning = turningOf(scene, stage, film);
  std::vector<bool> turns(scene.instances.size(), false);
  for (const std::uint32_t i : turning) turns[i] = true;
  TurningPictures pictures(scene, turning, "vrml_clouds.png");
  pictures.texture(folder);

  const std::vector<TileNode> tiles = tileTrees(scene, stage);
  std::vector<TileNode> others = tiles;
  for (TileNode& tile : others) {
    tile.children.clear();
    std::erase_if(tile.instances, [&](std::uint32_t i) { return turns[i]; });
  }
  std::vector<const TileNode*> squares;
  for (const TileNode& tile : others)
    if (!tile.instances.empty()) squares.push_back(&tile);
  const FilePictures afar(scene, squares, kAfar, "vrml_afar.png");
  afar.texture(folder);

  FilmNodes filmNodes(nodes, film);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    progress.step("writing VRML", static_cast<double>(t) / static_cast<double>(tiles.size()));
    nodes.open("Group", "children", "Tile_" + tiles[t].name);
    for (const std::uint32_t i : tiles[t].instances) {
      if (!turns[i]) continue;
      filmNodes.openFollower(i, scene.instances[i]);
      if (i < scene.clouds.size()) writeRecord(nodes, scene.clouds[i]);
      pictures.write(nodes, shapes, scene.instances[i]);
      nodes.close();
    }
    if (!others[t].instances.empty()) afar.writeSquare(shapes, others[t]);
    nodes.close();
  }
  filmNodes.finish();
}

}  // namespace cloudgen::writer
