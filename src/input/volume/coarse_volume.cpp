// SPDX-License-Identifier: Apache-2.0
#include "input/volume/coarse_volume.hpp"

#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::input {

CoarseVolume::CoarseVolume(const glm::dvec3& size, const glm::dvec3& finest) {
  constexpr double kMostAcross = 64;
  for (int axis = 0; axis < 3; ++axis) {
    volume_.size[axis] =
        static_cast<int>(std::clamp(std::round(size[axis] / finest[axis]), 1.0, kMostAcross));
    volume_.spacing[axis] = size[axis] / volume_.size[axis];
  }
  volume_.extinction.resize(static_cast<std::size_t>(volume_.size.x) *
                            static_cast<std::size_t>(volume_.size.y) *
                            static_cast<std::size_t>(volume_.size.z));
}

void CoarseVolume::add(const glm::dvec3& lower, const glm::dvec3& upper, double extinction) {
  const glm::dvec3 most = glm::dvec3(volume_.size),
                   from = glm::clamp(lower / volume_.spacing, glm::dvec3(0), most),
                   to = glm::clamp(upper / volume_.spacing, glm::dvec3(0), most);
  const auto overlap = [&](int axis, int cell) {
    return std::min<double>(to[axis], cell + 1) - std::max<double>(from[axis], cell);
  };
  for (int z = static_cast<int>(from.z); z < to.z; ++z)
    for (int y = static_cast<int>(from.y); y < to.y; ++y)
      for (int x = static_cast<int>(from.x); x < to.x; ++x)
        volume_.extinction[volume_.at({x, y, z})] +=
            static_cast<float>(extinction * overlap(0, x) * overlap(1, y) * overlap(2, z));
}

}  // namespace cloudgen::input
