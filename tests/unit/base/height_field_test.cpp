// SPDX-License-Identifier: Apache-2.0
#include "base/height_field.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace cloudgen::base {
namespace {

/// 3 by 2 points, 10 and 20 m apart: 0 1 2 / 4 5 6.
HeightField ramp() { return {3, 2, {100, 200}, {10, 20}, {0, 1, 2, 4, 5, 6}}; }

TEST(HeightField, IsBilinearAndEndsAtItsBorder) {
  const HeightField field = ramp();
  EXPECT_DOUBLE_EQ(field.heightAt(100, 200), 0);
  EXPECT_DOUBLE_EQ(field.heightAt(115, 210), 3.5);
  EXPECT_DOUBLE_EQ(field.heightAt(120, 220), 6);
  EXPECT_DOUBLE_EQ(field.heightAt(1e9, -1e9), 2);
  EXPECT_TRUE(field.covers(120, 220));
  EXPECT_FALSE(field.covers(120.1, 220));
  EXPECT_EQ(field.highest(), 6);
}

TEST(HeightField, NormalsLeanDownTheSlope) {
  const glm::vec3 normal = ramp().normal(1, 0);
  EXPECT_NEAR(normal.x / normal.y, -0.1, 1e-6);
  EXPECT_NEAR(normal.z / normal.y, -0.2, 1e-6);
  EXPECT_NEAR(ramp().normal(1, 0, 5).x / ramp().normal(1, 0, 5).y, -0.5, 1e-6);
}

TEST(HeightField, TrianglesFaceUpwards) {
  const HeightField field = ramp();
  const auto corners = trianglesOf(field);
  ASSERT_EQ(corners.size(), 12u);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      const int corner = static_cast<int>(corners[i + k]);
      return field.point(corner % field.columns, corner / field.columns);
    };
    EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).y, 0);
  }
}

}  // namespace
}  // namespace cloudgen::base
