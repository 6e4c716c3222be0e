// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/runtime.hpp"

namespace cloudgen::runtime {

/// A puff where it stands, for renderers that take no packs.
struct PlacedPuff {
  Vec3 center, sigma;          ///< metres
  float rotation[4];           ///< x, y, z, w: from its axes to the scene's
  float opticalDepth = 0;      ///< through its centre along its shortest axis
  Vec3 color;                  ///< display-encoded (sRGB), 0 to 1
  Vec3 forward;                ///< display-linear: added when one looks towards the sun
};

/// All puffs of the clouds that are there at a time (seconds from the pack's valid time), in their first level, lit as
/// the runtime is. Throws std::bad_alloc.
std::vector<PlacedPuff> placedPuffs(const Runtime& runtime, double seconds);

}  // namespace cloudgen::runtime
