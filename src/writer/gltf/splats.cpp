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
  const bool quantize = destination.splats.quantize;
  if (quantize) file.useExtension("KHR_mesh_quantization", true);
  const auto tiles = scene::tilesOf(scene);
  const SplatMaker maker(scene);
  std::vector<std::vector<SplatSource>> sources(tiles.size());
  destination.progress.step("splats", 0);
  base::parallelFor(tiles.size(), [&](std::size_t t) { sources[t] = maker.sourcesOf(tiles[t]); });
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const scene::Tile& tile = tiles[t];
    nlohmann::json extras{
        {"lower", arrayOf(tile.lower)}, {"upper", arrayOf(tile.upper)}, {"clouds", tile.instances.size()}};
    if (quantize) extras["optical_depth_step"] = kOpticalDepthStep;
    for (std::size_t part = 0; part < sources[t].size(); ++part) {
      std::string name = fmt::format("tile {} {}", tile.column, tile.row);
      if (part > 0) name += fmt::format(" part {}", part + 1);
      SplatSource& source = sources[t][part];
      const SplatUnit unit = quantize ? unitOf(source) : SplatUnit{};
      const int degree = destination.splats.degree;
      const Attributes attributes =
          quantize ? addQuantizedSplats(file, std::move(source), scene.sun.direction, degree, unit)
                   : addSplats(file, std::move(source), scene.sun.direction, degree);
      const int mesh = file.addMesh(
          name,
          {.attributes = attributes, .points = true, .extensions = {{kSplatting, &splattingExtension()}}});
      file.addNode({.name = name,
                    .mesh = mesh,
                    .translation = tileCenter(tile) + glm::dvec3(unit.lower),
                    .metersPerUnit = unit.meters,
                    .extras = &extras});
    }
  }
  file.write(destination.folder / "scene.splats.glb");
  destination.progress.step("splats", 1);
}

}  // namespace cloudgen::writer
