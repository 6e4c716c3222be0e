// SPDX-License-Identifier: Apache-2.0
// Meshes and volumes whose form is known.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/mesh.hpp"
#include "base/volume.hpp"

namespace cloudgen::test {

inline void addTriangles(base::Mesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& quads) {
  for (const auto& [a, b, c, d] : quads) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
}

/// A box with its middle at a point, closed.
inline base::Mesh boxMesh(const glm::dvec3& size, const glm::dvec3& middle = {0, 0, 0}) {
  base::Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(middle + 0.5 * size * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  addTriangles(mesh, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
  return mesh;
}

/// A ring that stands, its hole along z: 1 the radius of its middle line, 0.35 that of its tube.
inline base::Mesh ringMesh() {
  constexpr std::uint32_t kAround = 24, kAcross = 10;
  base::Mesh mesh;
  std::vector<std::array<std::uint32_t, 4>> quads;
  for (std::uint32_t i = 0; i < kAround; ++i)
    for (std::uint32_t k = 0; k < kAcross; ++k) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * k / kAcross;
      const double r = 1 + 0.35 * std::cos(b);
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.35 * std::sin(b));
      const std::uint32_t i1 = (i + 1) % kAround, k1 = (k + 1) % kAcross;
      quads.push_back({i * kAcross + k, i1 * kAcross + k, i1 * kAcross + k1, i * kAcross + k1});
    }
  addTriangles(mesh, quads);
  return mesh;
}

/// Two balls of even extinction, one above the other's side, in a box of 32 x 24 x 20 cells.
inline base::Volume twoBalls() {
  base::Volume volume{{32, 24, 20}, glm::dvec3(50), {}};
  for (int z = 0; z < 20; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x) {
        const glm::dvec3 p(x + 0.5, y + 0.5, z + 0.5);
        const bool inside = glm::distance(p, {9, 9, 10}) < 8 || glm::distance(p, {23, 15, 10}) < 7;
        volume.extinction.push_back(inside ? 0.02f : 0.0f);
      }
  return volume;
}

}  // namespace cloudgen::test
