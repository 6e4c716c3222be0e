// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "light/extinction_grid.hpp"

namespace cloudgen::light {

/// Optical depth from every cell of a grid to its edge along one direction, found slice by slice: each cell
/// continues the ray that reached the slice before it (Jimenez de Parga 2018, "no duplicate tracing"), so
/// the cost is one step a cell.
class DepthSweep {
 public:
  explicit DepthSweep(const ExtinctionGrid& grid);

  /// Fills the depths along a unit direction, any direction. Slices lie across its largest component.
  void towards(const glm::vec3& direction);
  /// Depth of the last sweep at a point, trilinear; 0 outside the grid.
  float at(const glm::vec3& point) const;
  /// Depths of the last sweep, x fastest, then y, then z.
  const std::vector<float>& cells() const { return depths_; }

 private:
  const ExtinctionGrid* grid_;
  std::vector<float> depths_;
  std::vector<float> reached_;  ///< depth half a step beyond the slice before, framed by zeros
  std::vector<float> shifted_;  ///< the same where the rays cross, along one of the slice's axes
  std::vector<float> row_, cells_;  ///< depths and extinctions of a row of a slice
};

}  // namespace cloudgen::light
