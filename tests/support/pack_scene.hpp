// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/picture.hpp"
#include "light/extinction_grid.hpp"
#include "light/optics.hpp"
#include "light/shade.hpp"
#include "support/small_scene.hpp"
#include "writer/copy_textures.hpp"
#include "writer/pack/pack.hpp"

/// Scenes made by hand whose clouds know how they answer to light, as production leaves them.
namespace cloudgen::test {

/// Bakes the light of every archetype and shades every heading by it.
inline scene::Scene withLight(scene::Scene scene) {
  std::vector<light::CloudTransfer> transfers;
  for (scene::Archetype& archetype : scene.archetypes) {
    transfers.push_back(light::bakeTransfer(archetype.puffs, light::ExtinctionGrid(archetype.puffs, 12),
                                            light::kWaterAsymmetry));
    archetype.response = light::responseOf(archetype.puffs, transfers.back(), 1, 1000);
  }
  for (scene::LitArchetype& lit : scene.lit) {
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    const glm::quat turnBack = glm::angleAxis(-scene::yawRadians(lit.yawStep), glm::vec3(0, 1, 0));
    lit.puffs = light::shadePuffs(archetype.puffs, transfers[lit.archetype],
                                  {turnBack * scene.sun.direction,
                                   light::sunColorAt(scene.sun.elevationDegrees, 1000), scene.sky},
                                  1);
  }
  return scene;
}

/// Two archetypes, 20 clouds.
inline scene::Scene packScene() { return withLight(smallScene()); }

/// A square sky of heaps and a few sheets, evenly strewn.
inline scene::Scene wideSky(int archetypes, int puffsEach, int clouds, float sideMeters) {
  std::vector<scene::Archetype> shapes;
  for (int a = 0; a < archetypes; ++a) {
    const float size = 0.7f + 0.6f * static_cast<float>(a) / static_cast<float>(archetypes);
    if (a % 8 == 7)
      shapes.push_back(sheet("Ci_" + std::to_string(a), base::Genus::Cirrus, 5000 * size, 400, puffsEach, 3, 0.15f, 0.4f));
    else
      shapes.push_back(heap("Cu_" + std::to_string(a), base::Genus::Cumulus, 1500 * size, 900, 4, puffsEach));
  }
  scene::Scene scene = withLight(sceneOf(std::move(shapes), clouds));
  base::RandomStream random(5, 0, base::Purpose::Test);
  for (scene::Instance& cloud : scene.instances) {
    cloud.position.x = static_cast<float>(random.uniform(0, sideMeters));
    cloud.position.z = -static_cast<float>(random.uniform(0, sideMeters));
  }
  return scene;
}

/// Grey sprites of four pixels a tile.
inline std::vector<writer::packed::Pictures> plainPictures(const scene::Scene& scene) {
  const std::string png = image::pngBytes({16, 16, 4, std::vector<unsigned char>(16 * 16 * 4, 128)});
  std::vector<writer::packed::Pictures> pictures;
  for (const base::Genus genus : writer::generaOf(scene)) pictures.push_back({genus, 4, 4, png, png, png});
  return pictures;
}

/// The pack of a scene with plain sprites, at an address that suits FlatBuffers.
inline std::string packOf(const scene::Scene& scene) { return writer::packBytes(scene, plainPictures(scene)); }

}  // namespace cloudgen::test
