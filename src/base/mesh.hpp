// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::base {

/// A triangle mesh, in any unit, y up. Corners are indices of points; counter-clockwise seen from outside, if
/// the mesh has an outside.
struct Mesh {
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace cloudgen::base
