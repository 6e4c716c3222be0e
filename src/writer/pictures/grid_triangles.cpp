// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/grid_triangles.hpp"

#include <algorithm>

namespace cloudgen::writer {
namespace {

/// Whether a point lies within the circle through the corners.
bool isInCircle(const GridTriangles::Triangle& triangle, const glm::ivec2& point) {
  const auto row = [&](int corner) {
    const glm::i64vec2 away(triangle.corners[static_cast<std::size_t>(corner)] - point);
    return std::array<std::int64_t, 3>{away.x, away.y, away.x * away.x + away.y * away.y};
  };
  const auto a = row(0), b = row(1), c = row(2);
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]) > 0;
}

}  // namespace

GridTriangles::GridTriangles(int cells) {
  const glm::ivec2 low(0), right(cells, 0), high(cells), left(0, cells);
  triangles_ = {{{low, right, high}, {-1, -1, 1}, true}, {{low, high, left}, {0, -1, -1}, true}};
}

std::vector<std::int32_t> GridTriangles::insert(const glm::ivec2& point, std::int32_t within) {
  struct Edge {
    glm::ivec2 from, to;
    std::int32_t across;
  };
  const auto at = [&](std::int32_t i) -> Triangle& { return triangles_[static_cast<std::size_t>(i)]; };
  // All whose circle the point lies in leave a hole that every edge of is seen from it.
  std::vector<std::int32_t> gone{within};
  std::vector<Edge> edges;
  at(within).isThere = false;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    const Triangle one = at(gone[i]);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int32_t next = one.across[e];
      if (next >= 0 && !at(next).isThere) continue;
      if (next >= 0 && isInCircle(at(next), point)) {
        at(next).isThere = false;
        gone.push_back(next);
      } else {
        edges.push_back({one.corners[e], one.corners[(e + 1) % 3], next});
      }
    }
  }
  // An edge may have been kept before the triangle beyond it went.
  std::erase_if(edges, [&](const Edge& edge) { return edge.across >= 0 && !at(edge.across).isThere; });
  // A point on the border has no triangle beyond it.
  std::erase_if(edges, [&](const Edge& edge) { return edge.across < 0 && doubleArea(edge.from, edge.to, point) == 0; });

  const auto first = static_cast<std::int32_t>(triangles_.size());
  const auto beginningWith = [&](auto end, const glm::ivec2& corner) {
    const auto found = std::ranges::find_if(edges, [&](const Edge& edge) { return edge.*end == corner; });
    return found == edges.end() ? -1 : first + static_cast<std::int32_t>(found - edges.begin());
  };
  for (const Edge& edge : edges) {
    const auto self = static_cast<std::int32_t>(triangles_.size());
    if (edge.across >= 0)
      for (std::size_t e = 0; e < 3; ++e)
        if (at(edge.across).corners[e] == edge.to) at(edge.across).across[e] = self;
    triangles_.push_back(
        {{edge.from, edge.to, point}, {edge.across, beginningWith(&Edge::from, edge.to), beginningWith(&Edge::to, edge.from)}, true});
  }
  return gone;
}

}  // namespace cloudgen::writer
