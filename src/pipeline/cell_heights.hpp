// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pipeline/canvas.hpp"

namespace cloudgen::pipeline {

/// Low, middle and high, by the base of a layer.
inline constexpr std::size_t kRanges = 3;
inline constexpr std::array<double, 2> kRangeBordersMeters{2000, 6000};
inline std::size_t rangeOf(double baseMeters) {
  return baseMeters < kRangeBordersMeters[0] ? 0 : baseMeters < kRangeBordersMeters[1] ? 1 : 2;
}

/// Where the clouds of each cell of a canvas begin and end for an observer, as against what its layers say: a
/// base where a little of the optical depth of the cell's lowest range lies below, a top where as much of that
/// of its highest range lies above.
class CellHeights {
 public:
  /// Of an empty canvas, with the layers that it was made of.
  CellHeights(const Canvas& canvas, std::span<const field::Layer> layers);

  /// By how much the squared errors of base and top together change, m2 (linear beyond a kilometre), when
  /// optical depth (a sum over pixels; below 0: taken away) is spread evenly between two heights of a cell,
  /// which is told by its index in the canvas.
  double changeBy(std::uint32_t cell, float baseMeters, float topMeters, double opticalDepth) const;
  void add(std::uint32_t cell, float baseMeters, float topMeters, double opticalDepth);
  /// The canvas was cleared.
  void clear();

 private:
  /// Of a profile: from a bin up to another.
  struct Window {
    std::size_t first = 0, end = 0;
  };
  struct Wanted {
    Window lowest, highest;
    float base = 0, top = 0;  ///< in bins
    double least = 0;         ///< optical depth under which a range counts as clear
  };
  void describe(std::span<const PaintedLayer> own, std::span<const field::Layer> layers, Wanted& wanted);
  double errorOf(const Wanted& wanted, const float* profile) const;
  float binOf(float meters) const;
  void spread(float* profile, float baseMeters, float topMeters, double opticalDepth) const;

  std::size_t bins_ = 1;
  float binMeters_ = 1;
  std::vector<Wanted> wanted_;   ///< of each cell
  std::vector<float> profiles_;  ///< of each cell, bins_ each
  mutable std::vector<float> changed_;
};

}  // namespace cloudgen::pipeline
