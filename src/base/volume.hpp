// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::base {

/// A box of cells that hold extinction, in any unit: the value of cell (x, y, z) is at
/// x + size.x * (y + size.y * z). y up. Lengths in metres or any other unit.
struct Volume {
  glm::ivec3 size{0};
  glm::dvec3 spacing{1};  ///< edges of a cell
  std::vector<float> extinction;

  std::size_t at(const glm::ivec3& cell) const {
    return static_cast<std::size_t>(cell.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(cell.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(cell.z));
  }
};

}  // namespace cloudgen::base
