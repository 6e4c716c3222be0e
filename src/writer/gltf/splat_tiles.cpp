// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_tiles.hpp"

#include <glm/common.hpp>
#include <tuple>

#include "light/shade.hpp"
#include "shape/blending.hpp"

namespace cloudgen::writer::gltf {
namespace {

/// Which puff, and where on the Morton curve.
struct Place {
  std::uint64_t morton;
  std::uint32_t instance, puff;
  bool operator<(const Place& other) const {
    return std::tie(morton, instance, puff) < std::tie(other.morton, other.instance, other.puff);
  }
};

/// The same cloud seen from the tile's centre. Moved before its puffs are placed: small numbers stay precise.
scene::Instance relativeTo(const glm::dvec3& center, scene::Instance instance) {
  instance.position = glm::vec3(glm::dvec3(instance.position) - center);
  return instance;
}

}  // namespace

glm::dvec3 tileCenter(const scene::Tile& tile) {
  return glm::round(0.5 * (glm::dvec3(tile.lower) + glm::dvec3(tile.upper)));
}

std::vector<Splat> splatsOf(const scene::Scene& scene, const scene::Tile& tile) {
  const glm::dvec3 center = tileCenter(tile);
  const glm::vec3 lower = glm::vec3(glm::dvec3(tile.lower) - center), extent = tile.upper - tile.lower;
  const float metersPerStep = std::max({extent.x, extent.y, extent.z, 1.0f}) / 65535.0f;

  std::vector<Place> places;
  for (const std::uint32_t i : tile.instances) {
    const scene::Instance cloud = relativeTo(center, scene.instances[i]);
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    for (std::uint32_t p = 0; p < lit.puffs.size(); ++p) {
      const shape::Puff puff =
          shape::widenedAcross(scene::placed(scene, cloud, archetype.puffs[p]), archetype.covering);
      if (splatOpacity(puff) >= kLeastOpacity)
        places.push_back({mortonOf(puff.center, lower, metersPerStep), i, p});
    }
  }
  std::sort(places.begin(), places.end());

  std::vector<Splat> splats;
  splats.reserve(places.size());
  for (const Place& place : places) {
    const scene::Instance cloud = relativeTo(center, scene.instances[place.instance]);
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    const shape::Puff puff =
        shape::widenedAcross(scene::placed(scene, cloud, archetype.puffs[place.puff]), archetype.covering);
    splats.push_back(splatOf(
        puff, light::inShadow(lit.puffs[place.puff], cloud.sunlight, scene.sun.color, scene.sky), scene.sun));
  }
  return splats;
}

}  // namespace cloudgen::writer::gltf
