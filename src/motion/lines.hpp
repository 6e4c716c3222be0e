// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::motion {

/// Numbers on a box of places, x fastest, then y, then z.
struct Lattice {
  glm::ivec3 places{0};
  std::vector<float> values;

  Lattice() = default;
  explicit Lattice(const glm::ivec3& size)
      : places(size),
        values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
               static_cast<std::size_t>(size.z)) {}
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(places.y) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(places.x) +
           static_cast<std::size_t>(x);
  }
  float at(int x, int y, int z) const { return values[index(x, y, z)]; }
  float& at(int x, int y, int z) { return values[index(x, y, z)]; }
};

/// How many lines are worked on at once, side by side.
inline constexpr int kLanes = 32;

/// Takes the lines of a lattice along an axis (0 x, 1 y, 2 z), kLanes at a time, on several threads: `work` gets
/// the values of place i of lane l at [i * kLanes + l] and what it leaves there is put back. Lanes over the edge
/// of the lattice hold zeros. `firstLine` is the place of lane 0 on the other two axes (0 on this), and lanes go
/// on along x, or along y where the lines lie along x.
using LineWork = std::function<void(float* values, const glm::ivec3& firstLine)>;
void alongLines(Lattice& lattice, int axis, const LineWork& work);

}  // namespace cloudgen::motion
