// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "base/thread.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/gltf/scene_extras.hpp"
#include "writer/gltf/splat_columns.hpp"

namespace cloudgen::writer {

using namespace gltf;

void writeSplats(const scene::Scene& scene, const Destination& destination) {
  GlbFile file(sceneExtras(scene));
  file.useExtension(kSplatting, false);
  const auto tiles = scene::tilesOf(scene);
  const SplatMaker maker(scene);
  std::vector<std::vector<SplatSource>> sources(tiles.size());
  destination.progress.step("splats", 0);
  base::parallelFor(tiles.size(), [&](std::size_t t) { sources[t] = maker.sourcesOf(tiles[t]); });
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const scene::Tile& tile = tiles[t];
    const nlohmann::json extras{
        {"lower", arrayOf(tile.lower)}, {"upper", arrayOf(tile.upper)}, {"clouds", tile.instances.size()}};
    for (std::size_t part = 0; part < sources[t].size(); ++part) {
      std::string name = fmt::format("tile {} {}", tile.column, tile.row);
      if (part > 0) name += fmt::format(" part {}", part + 1);
      const int mesh = file.addMesh(
          name, {.attributes = addSplats(file, std::move(sources[t][part]), scene.sun.direction,
                                          destination.splats.degree),
                 .points = true,
                 .extensions = {{kSplatting, &splattingExtension()}}});
      file.addNode({.name = name, .mesh = mesh, .translation = tileCenter(tile), .extras = &extras});
    }
  }
  file.write(destination.folder / "scene.splats.glb");
  destination.progress.step("splats", 1);
}

}  // namespace cloudgen::writer
