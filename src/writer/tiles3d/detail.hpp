// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/puff_light.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer::tiles3d {

/// The clouds of a tile, as indices of the scene's instances.
using Clouds = std::span<const std::uint32_t>;

/// How coarsely a tile draws its clouds. A cloud is all of its puffs, a handful, or one, whichever is the
/// coarsest whose puffs are no wider than `errorMeters` (one: than half of it). With a cell, clouds that are one puff and stand in
/// one cell of the ground and one band of height are drawn as one.
struct Detail {
  double errorMeters = 0;  ///< 0: all puffs; the visible width of the widest puff that stands for others
  double cellMeters = 0;   ///< 0: no clouds are joined
};

/// A puff in the scene frame, its light, and whose sprites it has.
struct LitPuff {
  shape::Puff puff;
  light::PuffLight light;
  base::Genus genus{};
  float covering = shape::kCoveringAmongMany;  ///< as a blended blob: shape::widenedAcross
};

/// The finest detail at which the clouds are at most `budget` puffs and which is coarser than `least`.
/// Where even one puff a cloud is too much, clouds are joined.
Detail detailWithin(const scene::Scene& scene, Clouds clouds, std::size_t budget, double leastErrorMeters);

/// The puffs of the clouds at that detail, by cloud (or cell), those that are too thin to be seen left out.
/// Joined clouds cover what they cover together if they overlap at random. But at full detail, mergedWithin() the error.
std::vector<LitPuff> puffsAt(const scene::Scene& scene, Clouds clouds, const Detail& detail);

}  // namespace cloudgen::writer::tiles3d
