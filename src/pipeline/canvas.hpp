// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "pipeline/footprint.hpp"

namespace cloudgen::pipeline {

/// A cloud on a canvas: where (metres from its corner; x along the rows, y along the columns of the grid),
/// how wide, how turned.
struct PaintedCloud {
  glm::dvec2 place{0};
  double widthMeters = 0;
  double turnRadians = 0;  ///< of the cloud's own x axis, from the canvas's x towards its -y
  bool mirrored = false;   ///< the canvas's y runs north
  const Footprint* footprint = nullptr;
};

/// Optical depth seen from above over a rectangle. What leaves it is what the neighbour, which is taken to be
/// alike, sends in at the other side, where it overlaps by chance. With mirrors it is thrown back at the
/// first and the last row, where it overlaps what it came from: clumps that go on beyond the border do both,
/// and the errors of either in the cover, of opposite sign, cancel.
class Canvas {
 public:
  Canvas(const glm::dvec2& sizeMeters, double pixelMeters, bool mirrors);
  /// Adds `opticalDepth` times the footprint; a negative one takes it away again.
  void add(const PaintedCloud& cloud, double opticalDepth);
  /// Share of the canvas above a value.
  double cover(double opticalDepth) const;
  float at(const glm::dvec2& place) const;

 private:
  int rowOf(int row) const;

  glm::dvec2 size_, pixel_{0};
  bool mirrors_ = false;
  int columns_ = 1, rows_ = 1;
  std::vector<float> values_;
};

}  // namespace cloudgen::pipeline
