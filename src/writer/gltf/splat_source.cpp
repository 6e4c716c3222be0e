// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat_source.hpp"

#include <array>
#include <glm/common.hpp>
#include <limits>
#include <tuple>

#include "base/thread.hpp"
#include "light/shade.hpp"
#include "shape/blending.hpp"

namespace cloudgen::writer::gltf {
namespace {

/// Takes a splat into what a source tells of all.
void take(SplatSource& source, const glm::vec3& center, const glm::vec3& sigma, float opticalDepth) {
  source.lower = glm::min(source.lower, center);
  source.upper = glm::max(source.upper, center);
  source.mostSigma = std::max({source.mostSigma, sigma.x, sigma.y, sigma.z});
  source.dense |= opticalDepth > kOpaqueOpticalDepth;
}

SplatSource emptySource(std::size_t count) {
  constexpr float kFar = std::numeric_limits<float>::max();
  return {count, glm::vec3(count ? kFar : 0), glm::vec3(count ? -kFar : 0)};
}

/// Widening takes at most three quarters of an optical depth; between the borders it must be asked.
bool isVisible(const shape::Puff& placedPuff, float covering) {
  const float opticalDepth = shape::frontalOpticalDepth(placedPuff);
  if (opticalDepth > 4.1f * kLeastOpacity) return true;
  return opticalDepth > 0.9f * kLeastOpacity &&
         splatOpacity(shape::widenedAcross(placedPuff, covering)) >= kLeastOpacity;
}

}  // namespace

glm::dvec3 tileCenter(const scene::Tile& tile) {
  return glm::round(0.5 * (glm::dvec3(tile.lower) + glm::dvec3(tile.upper)));
}

SplatSource sourceOf(std::span<const Splat> splats) {
  SplatSource source = emptySource(splats.size());
  for (const Splat& splat : splats) take(source, splat.center, splat.sigma, splat.opticalDepth);
  source.make = [splats](std::size_t first, std::span<Splat> out) {
    std::ranges::copy(splats.subspan(first, out.size()), out.begin());
  };
  return source;
}

void makeAll(const SplatSource& source,
             const std::function<void(std::size_t first, std::span<const Splat> splats)>& use) {
  constexpr std::size_t kBlock = 512;
  base::parallelFor((source.count + kBlock - 1) / kBlock, [&](std::size_t block) {
    std::array<Splat, kBlock> room;
    const std::size_t first = block * kBlock;
    const auto splats = std::span(room).first(std::min(kBlock, source.count - first));
    source.make(first, splats);
    use(first, splats);
  });
}

// What light::inShadow would find out anew for every puff.
SplatMaker::SplatMaker(const scene::Scene& scene) : scene_(scene) {
  dimming_.reserve(scene.instances.size());
  for (const scene::Instance& cloud : scene.instances)
    dimming_.push_back(light::dimming(cloud.sunlight, scene.sun.color, scene.sky));
}

shape::Puff SplatMaker::placed(const glm::dvec3& center, PuffOfCloud which) const {
  scene::Instance cloud = scene_.instances[which.instance];
  // Moved before its puffs are placed: small numbers stay precise.
  cloud.position = glm::vec3(glm::dvec3(cloud.position) - center);
  return scene::placed(scene_, cloud, archetypeOf(which.instance).puffs[which.puff]);
}

const scene::Archetype& SplatMaker::archetypeOf(std::uint32_t instance) const {
  return scene_.archetypes[scene_.lit[scene_.instances[instance].lit].archetype];
}

Splat SplatMaker::splat(const glm::dvec3& center, PuffOfCloud which) const {
  const scene::Instance& cloud = scene_.instances[which.instance];
  light::PuffLight light = scene_.lit[cloud.lit].puffs[which.puff];
  light.color *= dimming_[which.instance];
  light.forward *= cloud.sunlight;
  return splatOf(shape::widenedAcross(placed(center, which), archetypeOf(which.instance).covering), light,
                 scene_.sun);
}

std::vector<SplatMaker::PuffOfCloud> SplatMaker::visiblePuffs(const scene::Tile& tile) const {
  struct Place {
    std::uint64_t morton;
    PuffOfCloud which;
    bool operator<(const Place& other) const {
      return std::tie(morton, which.instance, which.puff) <
             std::tie(other.morton, other.which.instance, other.which.puff);
    }
  };
  const glm::dvec3 center = tileCenter(tile);
  const glm::vec3 lower = glm::vec3(glm::dvec3(tile.lower) - center), extent = tile.upper - tile.lower;
  const float metersPerStep = std::max({extent.x, extent.y, extent.z, 1.0f}) / 65535.0f;
  std::vector<Place> places;
  for (const std::uint32_t i : tile.instances)
    for (std::uint32_t p = 0; p < scene_.lit[scene_.instances[i].lit].puffs.size(); ++p)
      if (const shape::Puff puff = placed(center, {i, p}); isVisible(puff, archetypeOf(i).covering))
        places.push_back({mortonOf(puff.center, lower, metersPerStep), {i, p}});
  std::sort(places.begin(), places.end());
  std::vector<PuffOfCloud> puffs;
  puffs.reserve(places.size());
  for (const Place& place : places) puffs.push_back(place.which);
  return puffs;
}

SplatSource SplatMaker::source(const glm::dvec3& center, std::vector<PuffOfCloud> puffs) const {
  SplatSource source = emptySource(puffs.size());
  for (const PuffOfCloud which : puffs) {
    shape::Puff puff = placed(center, which);
    if (shape::frontalOpticalDepth(puff) > kOpaqueOpticalDepth)
      puff = shape::widenedAcross(puff, archetypeOf(which.instance).covering);
    constexpr float kMostWidening = 2;
    take(source, puff.center, kMostWidening * puff.sigma, shape::frontalOpticalDepth(puff));
  }
  source.make = [this, center, puffs = std::move(puffs)](std::size_t first, std::span<Splat> out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = splat(center, puffs[first + i]);
  };
  return source;
}

std::vector<SplatSource> SplatMaker::sourcesOf(const scene::Tile& tile, std::size_t most) const {
  const auto puffs = visiblePuffs(tile);
  std::vector<SplatSource> sources;
  for (std::size_t first = 0; first < puffs.size(); first += most) {
    const auto part = std::span(puffs).subspan(first, std::min(most, puffs.size() - first));
    sources.push_back(source(tileCenter(tile), {part.begin(), part.end()}));
  }
  return sources;
}

}  // namespace cloudgen::writer::gltf
