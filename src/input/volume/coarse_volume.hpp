// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/volume.hpp"

namespace cloudgen::input {

/// Gathers extinction in boxes into a volume of at most 64 cells along each axis: finer detail is lost when
/// puffs are fitted, and large files need not stand in memory.
class CoarseVolume {
 public:
  /// `size`: of the box that will be filled, positive in all axes, in the caller's unit; `finest`: of its
  /// cells.
  CoarseVolume(const glm::dvec3& size, const glm::dvec3& finest);
  /// Adds extinction that fills a box evenly; what lies outside of the volume is left out.
  void add(const glm::dvec3& lower, const glm::dvec3& upper, double extinction);
  base::Volume volume() && { return std::move(volume_); }

 private:
  base::Volume volume_;
};

}  // namespace cloudgen::input
