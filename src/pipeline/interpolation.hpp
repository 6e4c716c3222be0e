// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"

namespace cloudgen::pipeline {

/// What a layer is at a place of its cell.
struct LayerAtPlace {
  double fraction = 0, lowerMeters = 0, upperMeters = 0, opticalDepth = 0;
};

/// A layer and what continues it in the cells around: layers that overlap it in height by half of the thinner
/// one; elsewhere the sky is clear, and beyond the grid's border it goes on as it is here.
class LayerAround {
 public:
  /// (u, v) as in field::pointIn. Continuous from cell to cell: the cover, which says where clouds stand
  /// rather than how many, by geometric means between the centres; heights and optical depth are the cell's
  /// own in its middle half and pass into the neighbours' in the rest.
  LayerAtPlace at(double u, double v) const;
  /// (u, v) moved away from those sides of the cell beyond which the layer does not go on, so that a cloud
  /// that reaches this far along columns and rows stays inside; 0.4 at most, or all would stand in the
  /// middle.
  glm::dvec2 awayFromClearSides(glm::dvec2 place, glm::dvec2 reach) const;

 private:
  friend class LayersByCell;
  struct Neighbour {
    double columnsAway = 0, rowsAway = 0;
    const field::Layer* layer = nullptr;
  };
  const field::Layer* own_ = nullptr;
  std::vector<Neighbour> neighbours_;
  double fractionAt(double u, double v) const;
};

/// All layers by cell. They must outlive it.
class LayersByCell {
 public:
  LayersByCell(const field::Grid& grid, std::span<const field::Layer> layers);
  LayerAround of(const field::Layer& layer) const;

 private:
  const field::Grid& grid_;
  std::vector<const field::Layer*> byCell_;
};

}  // namespace cloudgen::pipeline
