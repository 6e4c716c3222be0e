// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/line_transform.hpp"
#include "motion/lines.hpp"

namespace cloudgen::motion {

/// Solves, on cubes of side 1 that close on themselves along x and z and lie between walls along y, for the field
/// whose sum of second differences is the given one less its mean; the mean of the field is 0. Directly, by the
/// waves of each axis: no iteration, and exact to the rounding of numbers of 32 bits.
class Poisson {
 public:
  explicit Poisson(const glm::ivec3& cells);
  /// In place.
  void solve(Lattice& field) const;

 private:
  glm::ivec3 cells_;
  LineTransform x_, y_, z_;
};

}  // namespace cloudgen::motion
