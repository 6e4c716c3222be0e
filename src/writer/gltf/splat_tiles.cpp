// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_tiles.hpp"

#include <glm/common.hpp>
#include <tuple>

#include "light/color.hpp"
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

/// Puts two zero bits between the 16 bits of a coordinate.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ff0000ff;
  bits = (bits | bits << 8) & 0x00f00f00f00f;
  bits = (bits | bits << 4) & 0x0c30c30c30c3;
  return (bits | bits << 2) & 0x249249249249;
}

std::uint64_t mortonOf(glm::vec3 place, glm::vec3 lower, float metersPerStep) {
  const glm::vec3 steps = glm::clamp((place - lower) / metersPerStep, 0.0f, 65535.0f);
  return spread(static_cast<std::uint64_t>(steps.x)) | spread(static_cast<std::uint64_t>(steps.y)) << 1 |
         spread(static_cast<std::uint64_t>(steps.z)) << 2;
}

/// The same cloud seen from the tile's centre. Moved before its puffs are placed: small numbers stay precise.
scene::Instance relativeTo(const glm::dvec3& center, scene::Instance instance) {
  instance.position = glm::vec3(glm::dvec3(instance.position) - center);
  return instance;
}

/// Light in the encoded colour space in which viewers add harmonics. Looking at an angle with cosine mu to
/// the sun, a puff shows its colour plus max(0, mu) of what is encoded with the forward light added; degrees
/// 0 and 1 that fit this best (least squares over the sphere) are a quarter and half of it.
void shade(Splat& splat, const light::PuffLight& puffLight, const light::Sun& sun) {
  const glm::vec3 base = light::srgbFromLinear(puffLight.color);
  const glm::vec3 lining = light::srgbFromLinear(puffLight.color + puffLight.forward * sun.color) - base;
  splat.color = base + 0.25f * lining;
  splat.towardsSun = 0.5f * lining;
}

}  // namespace

float splatOpacity(const shape::Puff& placedPuff) {
  return -std::expm1(-shape::frontalOpticalDepth(placedPuff));
}

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
    const auto& puffs = scene.archetypes[lit.archetype].puffs;
    for (std::uint32_t p = 0; p < lit.puffs.size(); ++p) {
      const shape::Puff puff = shape::widenedAcross(scene::placed(scene, cloud, puffs[p]));
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
    const shape::Puff puff =
        shape::widenedAcross(scene::placed(scene, cloud, scene.archetypes[lit.archetype].puffs[place.puff]));
    Splat splat{puff.center, puff.sigma, glm::normalize(puff.rotation), splatOpacity(puff),
                shape::frontalOpticalDepth(puff)};
    shade(splat, light::inShadow(lit.puffs[place.puff], cloud.sunlight, scene.sun.color, scene.sky),
          scene.sun);
    splats.push_back(splat);
  }
  return splats;
}

}  // namespace cloudgen::writer::gltf
