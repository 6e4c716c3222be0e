// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/grid_triangles.hpp"

#include <gtest/gtest.h>

#include <glm/vec2.hpp>

#include "base/random.hpp"

namespace cloudgen::writer {
namespace {

constexpr int kCells = 16;

bool holds(const GridTriangles::Triangle& one, const glm::ivec2& point) {
  const auto& [a, b, c] = one.corners;
  return doubleArea(a, b, point) >= 0 && doubleArea(b, c, point) >= 0 && doubleArea(c, a, point) >= 0;
}

/// Points at chance, on edges and on the border, too.
std::vector<glm::ivec2> insertSome(GridTriangles& triangles, int count) {
  std::vector<glm::ivec2> points{{0, 0}, {kCells, 0}, {kCells, kCells}, {0, kCells}};
  base::RandomStream random(1, 0, base::Purpose::Test, 1);
  for (int i = 0; i < count; ++i) {
    const glm::ivec2 point(static_cast<int>(random.index(kCells + 1)), static_cast<int>(random.index(kCells + 1)));
    if (std::ranges::find(points, point) != points.end()) continue;
    const auto found = std::ranges::find_if(triangles.all(), [&](const auto& one) { return one.isThere && holds(one, point); });
    triangles.insert(point, static_cast<std::int32_t>(found - triangles.all().begin()));
    points.push_back(point);
  }
  return points;
}

TEST(GridTriangles, FillTheSquareOnce) {
  GridTriangles triangles(kCells);
  insertSome(triangles, 200);
  int area = 0;
  for (const auto& one : triangles.all()) {
    if (!one.isThere) continue;
    const int own = doubleArea(one.corners[0], one.corners[1], one.corners[2]);
    EXPECT_GT(own, 0);
    area += own;
  }
  EXPECT_EQ(area, 2 * kCells * kCells);
}

TEST(GridTriangles, HaveNoPointWithinTheirCircles) {
  GridTriangles triangles(kCells);
  const auto points = insertSome(triangles, 60);
  for (const auto& one : triangles.all()) {
    if (!one.isThere) continue;
    // The middle of the circle, by Cramer's rule.
    const glm::dvec2 a(one.corners[0]), b = glm::dvec2(one.corners[1]) - a, c = glm::dvec2(one.corners[2]) - a;
    const double d = 2 * (b.x * c.y - b.y * c.x), bb = b.x * b.x + b.y * b.y, cc = c.x * c.x + c.y * c.y;
    const glm::dvec2 middle((c.y * bb - b.y * cc) / d, (b.x * cc - c.x * bb) / d);
    const double radius = std::hypot(middle.x, middle.y);
    for (const glm::ivec2& point : points) {
      const glm::dvec2 away = glm::dvec2(point) - a - middle;
      EXPECT_GT(std::hypot(away.x, away.y), radius - 1e-6);
    }
  }
}

TEST(GridTriangles, KnowWhatLiesAcrossTheirEdges) {
  GridTriangles triangles(kCells);
  insertSome(triangles, 100);
  for (const auto& one : triangles.all())
    for (std::size_t e = 0; e < 3 && one.isThere; ++e) {
      const glm::ivec2 from = one.corners[e], to = one.corners[(e + 1) % 3];
      const bool isBorder = (from.x == to.x && from.x % kCells == 0) || (from.y == to.y && from.y % kCells == 0);
      ASSERT_EQ(one.across[e] < 0, isBorder);
      if (isBorder) continue;
      const auto& other = triangles.all()[static_cast<std::size_t>(one.across[e])];
      EXPECT_TRUE(other.isThere);
      int shared = 0;
      for (std::size_t i = 0; i < 3; ++i) shared += other.corners[i] == to && other.corners[(i + 1) % 3] == from;
      EXPECT_EQ(shared, 1);
    }
}

}  // namespace
}  // namespace cloudgen::writer
