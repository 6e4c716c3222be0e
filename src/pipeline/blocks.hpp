// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"

namespace cloudgen::pipeline {

/// A rectangle of cells, aligned to the grid's first one, in which the clouds of a genus are placed together:
/// one cell where clouds are much smaller, more where a cloud spans cells. Along the rows it has more cells
/// where these are narrow (towards the poles), so that blocks stay about square.
struct Block {
  int half = 0;               ///< of a grid of two hemispheres
  int row = 0, column = 0;    ///< counted in blocks
  int rows = 1, columns = 1;  ///< cells
  int cellsOfRow = 1;         ///< in the row through its middle, by which columns of other rows are measured
  glm::dvec2 sizeMeters{0};   ///< along the rows and the columns
  auto address() const {
    return (static_cast<std::uint64_t>(half) << 60) | (static_cast<std::uint64_t>(row) << 30) |
           static_cast<std::uint64_t>(column);
  }
};

/// A place of a block.
struct PlaceInCell {
  std::uint32_t cell = 0;
  double u = 0, v = 0;  ///< as in field::pointIn
};

/// The place at (u, v) of a block, 0..1 along its rows and columns; nothing beyond the grid.
std::optional<PlaceInCell> placeIn(const field::Grid& grid, const Block& block, double u, double v);

/// Layers of one genus in a block; at most one of a cell: where layers of a genus lie over each other, each
/// has its group.
struct LayerGroup {
  Block block;
  base::Genus genus{};
  int stack = 0;                      ///< layers of this genus below it
  std::vector<std::uint32_t> layers;  ///< ascending by cell
};

/// All layers whose source does not count their clouds, by group, in an order that does not depend on theirs.
std::vector<LayerGroup> groupLayers(const field::Grid& grid, const Generalisation& general,
                                    std::span<const field::Layer> layers);

/// Uniform in 0..1, spread evenly over the blocks: of every 4 (16, 64, ..) that make up a square one is in
/// each quarter (sixteenth, ..), so that what is drawn by chance in single blocks is right in many.
double evenChance(const Block& block, std::uint64_t seed);

}  // namespace cloudgen::pipeline
