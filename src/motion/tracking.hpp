// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::motion {

/// A cloud at one of the times, carried by the wind to the moment halfway to the other.
struct CarriedCloud {
  glm::dvec2 place{0};  ///< x and z of the scene
  float widthMeters = 0, baseMeters = 0, depthMeters = 0;
  base::Genus genus{};
  float opticalDepth = 0;  ///< vertical
  double middleMeters() const { return baseMeters + 0.5 * depthMeters; }
};

/// Which cloud of the other time this one is, or was.
struct Fate {
  std::optional<std::uint32_t> partner;
  /// The partner goes on as another cloud, with which this one merges (or from which it splits).
  bool aside = false;
};

/// What became of the clouds of one time, and where those of the next come from.
struct Tracking {
  std::vector<Fate> earlier, later;
};

/// Matches clouds that overlap once the wind has carried them halfway towards each other, of the same genus or one that
/// it turns into, of like size and height: each with one, the best first, and again where both win by changing partners.
/// What is left lies aside of the best that it overlaps (a split or a merger), or comes and goes alone.
Tracking track(std::span<const CarriedCloud> earlier, std::span<const CarriedCloud> later);

/// How well two clouds match, 0 to 1; 0 where they cannot be the same.
double likeness(const CarriedCloud& a, const CarriedCloud& b);

}  // namespace cloudgen::motion
