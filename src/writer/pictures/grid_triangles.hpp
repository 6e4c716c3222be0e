// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace cloudgen::writer {

/// Delaunay triangles of points of a square grid, point by point (Bowyer 1981, Watson 1981). Exact: coordinates are
/// whole numbers below 2^12.
class GridTriangles {
 public:
  struct Triangle {
    std::array<glm::ivec2, 3> corners;        ///< counter-clockwise
    std::array<std::int32_t, 3> across{-1, -1, -1};  ///< beyond the edge from a corner to the next; -1: nothing
    bool isThere = true;                      ///< false: others have taken its place
  };

  /// The two halves of a square of so many cells along a side.
  explicit GridTriangles(int cells);

  /// Those that were there once, too.
  const std::vector<Triangle>& all() const { return triangles_; }

  /// Adds a point that lies in a triangle or on its edge and is no corner. The new triangles are the last of all();
  /// tells which ones have gone.
  std::vector<std::int32_t> insert(const glm::ivec2& point, std::int32_t within);

 private:
  std::vector<Triangle> triangles_;
};

/// Twice the area of a triangle, negative if it is clockwise.
inline int doubleArea(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace cloudgen::writer
