// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "motion/fluid.hpp"

namespace cloudgen::test {

inline double greatestDivergence(const motion::Fluid& fluid) {
  double greatest = 0;
  for (int z = 0; z < fluid.cells().z; ++z)
    for (int y = 0; y < fluid.cells().y; ++y)
      for (int x = 0; x < fluid.cells().x; ++x)
        greatest = std::max(greatest, std::abs(static_cast<double>(fluid.divergence(x, y, z))));
  return greatest;
}

}  // namespace cloudgen::test
