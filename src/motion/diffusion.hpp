// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "motion/lines.hpp"

namespace cloudgen::motion {

/// What lies at the ends of a row: itself again, walls that let nothing through, or zeros (its first and last
/// values are them).
enum class Rim { Periodic, Closed, Zero };

/// One implicit step of diffusion along the rows of an axis: (1 - number * second difference) of the result is what
/// was there, by elimination (Thomas), where the row closes on itself with the correction of Sherman and Morrison.
/// `number` is diffusivity * time / cell^2. Stable and without overshoot for every number; one axis after the
/// other makes a step in space, as the axes' operators commute.
class RowDiffusion {
 public:
  RowDiffusion(int places, Rim rim, float number);
  /// kLanes rows, place i of lane l at [i * kLanes + l].
  void step(float* rows) const;

 private:
  void eliminate(float* rows, int lanes) const;

  int places_;
  Rim rim_;
  std::vector<float> lower_, over_, inverse_;  ///< before the diagonal; after it, over the pivot; 1 / pivot
  std::vector<float> correction_;              ///< of a closed row
  float corner_ = 0, correctionShare_ = 0;
};

/// A step of diffusion of a lattice that closes on itself along x and z.
void diffuse(Lattice& lattice, Rim vertical, float number);

}  // namespace cloudgen::motion
