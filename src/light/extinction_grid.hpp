// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::light {

/// The extinction of a set of puffs on a regular voxel grid, for optical depths between them.
class ExtinctionGrid {
 public:
  /// About `cellsAlongLongest` cells along the longest side of the puffs' box; the puffs' extinction area is
  /// kept exactly.
  ExtinctionGrid(std::span<const shape::Puff> puffs, int cellsAlongLongest);

  /// Optical depth from a point to the edge of the grid along a unit direction (trilinear samples at
  /// half-cell steps), leaving out the first `skipMeters`.
  float opticalDepth(const glm::vec3& from, const glm::vec3& direction, float skipMeters) const;
  /// Extinction per metre at a point, trilinear; 0 outside.
  float extinction(const glm::vec3& point) const;
  /// Gradient of the extinction over one cell, 1/m per cell: it points into the cloud.
  glm::vec3 gradient(const glm::vec3& point) const;
  float cellMeters() const { return cell_; }

 private:
  float at(int x, int y, int z) const;

  glm::vec3 lower_{0};
  float cell_ = 1;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<float> values_;
};

}  // namespace cloudgen::light
