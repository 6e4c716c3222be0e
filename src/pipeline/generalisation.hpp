// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/options.hpp"

namespace cloudgen::pipeline {

/// How the puff budget is spent: as in cartography, a small budget draws fewer, larger and simpler clouds of
/// the same cover and water.
struct Generalisation {
  double narrowestMeters = 0;  ///< of clouds that cover all of their cell: the least that the budget can show
  double widestMeters = 1e9;   ///< that narrowestMeters may be: an eighth of the box
  double detail = 1;  ///< puffs of a cloud, as a share of what its width asks for; 0 as few as may be
  /// Sheets are made of elements no wider than that, so that they can tell the cover of a cell.
  double elementMeters = 1e9;
  std::array<int, base::kGenusCount> puffsPerCloud{};  ///< one level of detail a genus
  bool operator==(const Generalisation&) const = default;
};

struct MeasuredClouds;

/// Puffs that a genus needs to be told near by: sections times billboards.
int fewestPuffs(const shape::Recipe& recipe);

/// Width of a cloud of a layer before enlargement, metres: heaps follow their depth, sheets the recipe.
double naturalWidthMeters(const shape::Recipe& recipe, double depthMeters);

/// Ground that one cloud stands for when its layer is continuous: its footprint, or for sheets the square of
/// the spacing at which elements overlap to an even cover.
double coveredSquareMeters(const shape::Recipe& recipe, double widthMeters);

/// Mean width of clouds of which each covers so much: the inverse of coveredSquareMeters, within three
/// quarters of the recipe's least and twice its greatest width. For layers whose source counts their clouds.
double countedWidthMeters(const shape::Recipe& recipe, double coversSquareMeters);

/// Mean width of a layer's clouds under a generalisation. Where they cover little of their cell they are
/// narrower: the error that a single cloud makes in the cover weighs more there.
double meanWidthMeters(const Generalisation& general, const shape::Recipe& recipe, double depthMeters,
                       double fraction);

/// Widths over natural ones, at least 1: the mean over the cover of all layers.
double enlargementOf(const Generalisation& general, std::span<const field::Layer> layers,
                     const Options& options);

/// Enlargement and level of detail such that all clouds of the layers inside the box take about `maxPuffs`:
/// wider clouds are told by fewer puffs, and by as few as may be before they are wider than the model's
/// cells. Clouds that the source counts are never enlarged: they stay as many. What is measured of drawn clouds
/// is added to `measured`, and not measured again under the same options.
Generalisation generalise(const field::Grid& grid, std::span<const field::Layer> layers,
                          const Options& options, const base::GeoBox& box, double maxPuffs,
                          MeasuredClouds& measured);

}  // namespace cloudgen::pipeline
