// SPDX-License-Identifier: Apache-2.0
// Reference for optical depths: one ray a question, small steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "light/extinction_grid.hpp"

namespace cloudgen::test {

/// Optical depth from a point to the edge of the grid along a unit direction: trilinear samples at quarters
/// of a cell, which is about exact for a trilinear field.
inline float marchedDepth(const light::ExtinctionGrid& grid, const glm::vec3& from,
                          const glm::vec3& direction, float stepCells = 0.25f) {
  const glm::vec3 upper = grid.lower() + glm::vec3(grid.size()) * grid.cellMeters();
  float leave = 1e30f;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > 1e-6f)
      leave = std::min(
          leave, ((direction[axis] > 0 ? upper[axis] : grid.lower()[axis]) - from[axis]) / direction[axis]);
  const float step = stepCells * grid.cellMeters();
  double depth = 0;
  for (float along = 0.5f * step; along < leave; along += step)
    depth += static_cast<double>(grid.extinction(from + direction * along)) * step;
  return static_cast<float>(depth);
}

/// The middle of a cell.
inline glm::vec3 cellCenter(const light::ExtinctionGrid& grid, int x, int y, int z) {
  return grid.lower() + (glm::vec3(x, y, z) + 0.5f) * grid.cellMeters();
}

}  // namespace cloudgen::test
