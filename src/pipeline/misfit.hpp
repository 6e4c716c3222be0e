// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pipeline/canvas.hpp"
#include "pipeline/cell_heights.hpp"

namespace cloudgen::pipeline {

/// A cell, or a layer of it, that covers this share of it and more is a full sheet.
inline constexpr double kFullCover = 0.985;

/// How far a canvas is from what its layers want: squared errors of the cover of each layer of each cell and
/// of all together, of optical depth, of base and top, of what strays in, and of the mean cover of each genus
/// and of low, middle and high clouds.
class Misfit {
 public:
  /// Of an empty canvas, which must outlive it; `layers` are those it was made of.
  Misfit(const Canvas& canvas, std::span<const field::Layer> layers);

  /// Pixels of a cell (by its index in the canvas) that its layers should cover together.
  double wantedOfAll(std::uint32_t cell) const { return wantedOfAll_[cell]; }
  void want(std::uint32_t cell, double pixels) { wantedOfAll_[cell] = pixels; }
  /// From now on optical depth and the means of the whole sky count: every layer has had its turn.
  void judgeTheWholeSky() { judgesTheWholeSky_ = true; }

  /// How much nearer (below 0) or further a stroke takes the canvas to what is wanted, in pixels.
  double changeBy(const Stroke& stroke) const;
  /// The part of it that is undone when others of a layer (by its index in the canvas) hold what a stroke
  /// took away from it: that of optical depth and heights of its cell.
  double changeAsGiven(const Stroke& taken, std::uint32_t layer) const;

  /// A stroke was painted.
  void note(const Stroke& stroke);
  /// The canvas was cleared.
  void restart();

 private:
  /// Covered pixels of the whole sky beyond those that are wanted: of a genus, of low, middle or high
  /// clouds, of all.
  struct Surplus {
    std::array<double, base::kGenusCount> ofGenus{};
    std::array<double, kRanges> ofRange{};
    double ofAll = 0;
  };
  static Surplus changeOfSurplus(const Stroke& stroke);
  double changeOfMeans(const Surplus& change) const;
  double changeOfDepth(const PaintedCell& cell, const PaintedLayer& layer, double opticalDepth) const;
  double changeOfHeights(const Stroke& stroke) const;
  double changeOfHeights(const Stroke& stroke, const Stroke::Part& part, double opticalDepth) const;

  const Canvas& canvas_;
  std::span<const field::Layer> layers_;
  std::vector<double> wantedOfAll_;  ///< of the layers filled so far
  double pixels_ = 0;                ///< of all cells
  bool judgesTheWholeSky_ = false;
  Surplus surplus_;
  CellHeights heights_;
};

}  // namespace cloudgen::pipeline
