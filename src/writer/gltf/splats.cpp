// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "writer/gltf/gltf.hpp"
#include "writer/gltf/scene_extras.hpp"
#include "writer/gltf/splat_columns.hpp"
#include "writer/gltf/splat_tiles.hpp"

namespace cloudgen::writer {
namespace {

using namespace gltf;

constexpr std::uint64_t kBytesOfSplat = 12 + 16 + 12 + 4 + 12 + 3 * 12 + 4 + 4;
}  // namespace

void writeSplats(const scene::Scene& scene, const Destination& destination) {
  GlbFile file(sceneExtras(scene));
  file.reserve(scene::drawnPuffs(scene) * kBytesOfSplat);
  const auto tiles = scene::tilesOf(scene);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    destination.progress.step("splats", static_cast<double>(t) / static_cast<double>(tiles.size()));
    const scene::Tile& tile = tiles[t];
    const auto splats = splatsOf(scene, tile);
    const nlohmann::json extras{
        {"lower", arrayOf(tile.lower)}, {"upper", arrayOf(tile.upper)}, {"clouds", tile.instances.size()}};
    for (std::size_t start = 0, part = 0; start < splats.size(); start += kMostSplatsOfTile, ++part) {
      const auto run = std::span(splats).subspan(start, std::min(kMostSplatsOfTile, splats.size() - start));
      std::string name = fmt::format("tile {} {}", tile.column, tile.row);
      if (part > 0) name += fmt::format(" part {}", part + 1);
      const int mesh = file.addMesh(name, {.attributes = addSplats(file, run, scene.sun.direction),
                                           .points = true,
                                           .extensions = {{kSplatting, &splattingExtension()}}});
      file.addNode({.name = name, .mesh = mesh, .translation = tileCenter(tile), .extras = &extras});
    }
  }
  if (tiles.empty()) file.useExtension(kSplatting, false);
  file.write(destination.folder / "scene.splats.glb");
  destination.progress.step("splats", 1);
}

}  // namespace cloudgen::writer
