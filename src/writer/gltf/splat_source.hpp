// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "writer/gltf/splat.hpp"

namespace cloudgen::writer::gltf {

/// Viewers order the splats of one primitive among themselves, and primitives as wholes: few tiles
/// (scene::tilesOf) look better than many.
inline constexpr std::size_t kMostSplatsOfTile = 200'000;

/// Splats that are made when they are written, in any number of pieces and on several threads.
struct SplatSource {
  std::size_t count = 0;
  glm::vec3 lower{0}, upper{0};  ///< box around their centres
  bool dense = false;            ///< some are denser than kOpaqueOpticalDepth
  float mostSigma = 0;           ///< no deviation is more
  /// Makes as many as there is room for, from the one of that index on.
  std::function<void(std::size_t first, std::span<Splat> out)> make;
};

/// Splats that are there already and outlive the source.
SplatSource sourceOf(std::span<const Splat> splats);

/// Makes all splats, some hundred at a time on several threads; `use` gets each such block and the index of
/// its first, in any order.
void makeAll(const SplatSource& source,
             const std::function<void(std::size_t first, std::span<const Splat> splats)>& use);

/// Makes the splats of a scene, which it refers to.
class SplatMaker {
 public:
  explicit SplatMaker(const scene::Scene& scene);

  /// The visible puffs of a tile's clouds, their centres relative to the tile's, in Morton order, equal
  /// places by instance and puff; at most `most` a source. The maker must outlive them.
  std::vector<SplatSource> sourcesOf(const scene::Tile& tile, std::size_t most = kMostSplatsOfTile) const;

 private:
  struct PuffOfCloud {
    std::uint32_t instance, puff;
  };

  const scene::Archetype& archetypeOf(std::uint32_t instance) const;
  shape::Puff placed(const glm::dvec3& center, PuffOfCloud which) const;
  Splat splat(const glm::dvec3& center, PuffOfCloud which) const;
  std::vector<PuffOfCloud> visiblePuffs(const scene::Tile& tile) const;
  SplatSource source(const glm::dvec3& center, std::vector<PuffOfCloud> puffs) const;

  const scene::Scene& scene_;
  std::vector<glm::vec3> dimming_;  ///< of each instance
};

/// The middle of a tile's box, in whole metres, so that it is exact as a float and short as a text.
glm::dvec3 tileCenter(const scene::Tile& tile);

}  // namespace cloudgen::writer::gltf
