// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "check/fidelity/footprint.hpp"
#include "check/fidelity/model_columns.hpp"

namespace cloudgen::check {

/// Looks straight down on a written scene, ray by ray. The optical depth of a ray is the sum of the column
/// integrals of the blobs it meets. It is cloudy where what viewers draw lets no more light through than
/// kCloudyOpticalDepth does: they blend a blob with the opacity of its centre times the Gaussian, so that the
/// ray is left -ln of the product of (1 - opacity) as its drawn optical depth; and cloudy in a range of heights
/// where the part of that within it is.
class Imager {
 public:
  /// Sorts the footprints into bins; they must outlive it.
  explicit Imager(std::span<const Footprint> footprints);

  /// The column that the rays (x and z) look at; its ranges and where to look for base and top are the
  /// model's. May be called by several threads.
  ColumnView look(std::span<const glm::dvec2> rays, const ModelColumn& column) const;

 private:
  struct BinRange {
    int left, right, top, bottom;
  };
  BinRange binsOf(const Footprint& footprint) const;

  std::span<const Footprint> footprints_;
  glm::dvec2 lower_{0};
  double binMeters_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> start_, members_;
};

}  // namespace cloudgen::check
