// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/options.hpp"

namespace cloudgen::pipeline {

/// How the puff budget is spent: as in cartography, a small budget draws fewer and larger clouds of the same
/// cover and water.
struct Generalisation {
  /// Widths times this, >= 1 (those of sheets, whose elements are wide by nature, times its root), as far as
  /// widestMeters lets them.
  double enlargement = 1;
  double meanEnlargement = 1;  ///< what comes of both, the mean over the covered ground
  /// Enlarged clouds stay within half a model cell or, where the budget wants more, a twelfth of the box.
  double widestMeters = 1e9;
  std::array<int, base::kGenusCount> puffsPerCloud;  ///< one level of detail a genus
  /// Rows of cells in which the clouds of a genus are placed together (Block): 1 where cells are much wider
  /// than clouds, else a power of 2.
  std::array<int, base::kGenusCount> blockCells;
};

/// Puffs that a genus needs to be told: at the coarsest level, sections times billboards.
int fewestPuffs(const shape::Recipe& recipe);

/// Width of a cloud of a layer before enlargement, metres: heaps follow their depth, sheets the recipe.
double naturalWidthMeters(const shape::Recipe& recipe, double depthMeters);

/// Ground that one cloud stands for when its layer is continuous: its footprint, or for sheets the square of
/// the spacing at which elements overlap to an even cover.
double coveredSquareMeters(const shape::Recipe& recipe, double widthMeters);

/// Mean width of clouds of which each covers so much: the inverse of coveredSquareMeters, within three
/// quarters of the recipe's least and twice its greatest width. For layers whose source counts their clouds.
double countedWidthMeters(const shape::Recipe& recipe, double coversSquareMeters);

/// Mean width of a layer's clouds, enlarged.
double meanWidthMeters(const Generalisation& general, const shape::Recipe& recipe, double depthMeters);

/// Enlargement and level of detail such that all clouds of the layers inside the box take about `maxPuffs`.
/// Clouds that the source counts are never enlarged: they stay as many.
Generalisation generalise(const field::Grid& grid, std::span<const field::Layer> layers,
                          const Options& options, const base::GeoBox& box);

}  // namespace cloudgen::pipeline
