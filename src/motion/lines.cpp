// SPDX-License-Identifier: Apache-2.0
#include "motion/lines.hpp"

#include <algorithm>

#include "base/thread.hpp"

namespace cloudgen::motion {

void alongLines(Lattice& lattice, int axis, const LineWork& work) {
  const int laneAxis = axis == 0 ? 1 : 0, outerAxis = 3 - axis - laneAxis;
  const glm::ivec3& size = lattice.places;
  const std::size_t strides[3] = {1, static_cast<std::size_t>(size.x),
                                  static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  const int blocks = (size[laneAxis] + kLanes - 1) / kLanes;
  base::parallelFor(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(size[outerAxis]),
                    [&](std::size_t task) {
    glm::ivec3 first(0);
    first[laneAxis] = static_cast<int>(task) % blocks * kLanes;
    first[outerAxis] = static_cast<int>(task) / blocks;
    const int lanes = std::min(kLanes, size[laneAxis] - first[laneAxis]);
    std::vector<float> buffer(static_cast<std::size_t>(size[axis]) * kLanes, 0.0f);
    float* const corner = &lattice.values[lattice.index(first.x, first.y, first.z)];
    const auto each = [&](const auto& move) {
      for (int i = 0; i < size[axis]; ++i)
        for (int lane = 0; lane < lanes; ++lane)
          move(corner[static_cast<std::size_t>(i) * strides[axis] +
                      static_cast<std::size_t>(lane) * strides[laneAxis]],
               buffer[static_cast<std::size_t>(i * kLanes + lane)]);
    };
    each([](float& outside, float& inside) { inside = outside; });
    work(buffer.data(), first);
    each([](float& outside, float& inside) { outside = inside; });
  });
}

}  // namespace cloudgen::motion
