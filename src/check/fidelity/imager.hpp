// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "check/fidelity/footprint.hpp"
#include "check/fidelity/model_columns.hpp"

namespace cloudgen::check {

/// What the imager sees of a column.
struct SeenColumn {
  ColumnView view;
  /// Cover as viewers blend it: a ray is cloudy where 1 - product of (1 - opacity) is that of
  /// kCloudyOpticalDepth, a blob's opacity at the ray being that of its centre times the Gaussian.
  double drawnCover = 0;
};

/// Looks straight down on a written scene, ray by ray. The optical depth of a ray is the sum of the column
/// integrals of the blobs it meets; it is cloudy where that exceeds kCloudyOpticalDepth, and in a range of
/// heights where the part within it does.
class Imager {
 public:
  /// Sorts the footprints into bins; they must outlive it.
  explicit Imager(std::span<const Footprint> footprints);

  /// The column that the rays (x and z) look at; its ranges and where to look for base and top are the
  /// model's. May be called by several threads.
  SeenColumn look(std::span<const glm::dvec2> rays, const ModelColumn& column) const;

 private:
  struct BinRange {
    int left, right, top, bottom;
  };
  BinRange binsOf(const Footprint& footprint) const;

  std::span<const Footprint> footprints_;
  std::vector<float> opacities_;  ///< of their centres
  glm::dvec2 lower_{0};
  double binMeters_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> start_, members_;
};

}  // namespace cloudgen::check
