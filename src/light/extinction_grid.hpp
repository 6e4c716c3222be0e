// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shape/puff.hpp"

namespace cloudgen::light {

/// Cells along the longest side of the box that so many puffs can fill with detail, 12 to 90.
int cellsAlongLongestFor(std::size_t puffs);

/// The extinction of a set of puffs on a regular voxel grid, for optical depths between them.
class ExtinctionGrid {
 public:
  /// About `cellsAlongLongest` cells along the longest side of the puffs' box, up to 2.5 times as many for more
  /// than 20,000 puffs; the puffs' extinction area is kept exactly.
  ExtinctionGrid(std::span<const shape::Puff> puffs, int cellsAlongLongest);

  /// Extinction per metre at a point, trilinear; 0 outside.
  float extinction(const glm::vec3& point) const;
  /// Gradient of the extinction over one cell, 1/m per cell: it points into the cloud.
  glm::vec3 gradient(const glm::vec3& point) const;
  float cellMeters() const { return cell_; }
  /// Number of cells along each axis, and the corner of the first one.
  glm::ivec3 size() const { return {nx_, ny_, nz_}; }
  const glm::vec3& lower() const { return lower_; }
  /// Extinction per metre of every cell, x fastest, then y, then z.
  const std::vector<float>& cells() const { return values_; }
  /// A field of one value a cell at a point, trilinear; 0 outside.
  float sample(const std::vector<float>& field, const glm::vec3& point) const;

 private:
  glm::vec3 lower_{0};
  float cell_ = 1;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<float> values_;
};

}  // namespace cloudgen::light
