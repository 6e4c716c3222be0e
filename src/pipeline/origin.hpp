// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "field/source.hpp"
#include "light/moon.hpp"
#include "light/sky.hpp"
#include "pipeline/options.hpp"
#include "pipeline/terrain.hpp"

namespace cloudgen::pipeline {

/// Step 1: where and when the scene is.
struct Origin {
  base::LocalFrame frame;
  std::vector<std::uint32_t> cells;  ///< grid cells that touch the box, ascending
  Ground ground;
  light::Sun sun;
  light::Sky sky;
  light::Moon moon;  ///< as if new and set, where the sun's place was chosen
  /// Towards the sun by which clouds shade each other: that of `sun`, unless later times are lit by the first's.
  glm::vec3 shading{0, 1, 0};
  std::vector<std::string> warnings;
};

/// Scene frame, the model cells in it, the ground, and the sun: where it stands at the valid time over the
/// middle of the box, or as --sun says, whatever its elevation. A night is drawn in the light of its moon or, with
/// --sun, of a half moon, and a warning says so. `grid` is the one whose cells the clouds stand in: the source's, or a finer
/// typing's. Throws InputError if the box lies outside the grid.
Origin locateOrigin(const field::Source& source, const field::Grid& grid, const Options& options);

}  // namespace cloudgen::pipeline
