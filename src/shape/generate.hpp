// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "shape/puff.hpp"
#include "shape/recipe.hpp"

namespace cloudgen::shape {

/// One cloud to be shaped. Origin at the middle of its base, y up, wind along +x.
struct ShapeRequest {
  double widthMeters = 1000, depthMeters = 500;
  double opticalDepth = 10;  ///< vertical, mean over the nominal footprint (a disc of the width)
  double tilt = 0;           ///< how far the top leans downwind, as a share of the depth
  int puffs =
      500;  ///< budget; the result is near it, never above 1.5 times (but at least one puff a section)
  std::uint64_t seed = 0, variant = 0;
  bool even = false;    ///< thin: most of it one soft puff, for parts of it could not be seen
  bool closed = false;  ///< cells have thin cloud between them
};

struct CloudShape {
  std::vector<Puff> puffs;                  ///< ordered by section
  std::vector<std::uint32_t> sectionStart;  ///< sections + 1 entries
};

/// Shapes a cloud by its recipe. Deterministic in the request. The extinction is scaled so that the integral
/// of extinction over the cloud proper (without precipitation) is opticalDepth times the nominal footprint.
CloudShape generate(const Recipe& recipe, const ShapeRequest& request);

/// Area of the nominal footprint: a disc of the width.
double footprintSquareMeters(double widthMeters);

}  // namespace cloudgen::shape
