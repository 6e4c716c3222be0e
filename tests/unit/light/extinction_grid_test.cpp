// SPDX-License-Identifier: Apache-2.0
#include "light/extinction_grid.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "support/ball.hpp"

namespace cloudgen::light {
namespace {

using test::ball;

/// The integral of the trilinear field: exact with samples one cell apart.
double integral(const ExtinctionGrid& grid, const shape::Bounds& around) {
  const double cell = grid.cellMeters();
  double sum = 0;
  for (double z = around.lower.z - 3 * cell; z < around.upper.z + 3 * cell; z += cell)
    for (double y = around.lower.y - 3 * cell; y < around.upper.y + 3 * cell; y += cell)
      for (double x = around.lower.x - 3 * cell; x < around.upper.x + 3 * cell; x += cell)
        sum += grid.extinction(glm::vec3(x, y, z));
  return sum * cell * cell * cell;
}

TEST(ExtinctionGrid, KeepsTheExtinctionArea) {
  base::RandomStream random(3, 1, base::Purpose::Test);
  std::vector<shape::Puff> puffs;
  double area = 0;
  for (int i = 0; i < 60; ++i) {
    shape::Puff puff =
        ball(glm::dvec3(random.uniform(-800, 800), random.uniform(0, 400), random.uniform(-500, 500)),
             static_cast<float>(random.uniform(5, 120)), 0.03f);
    puff.sigma.y *= 0.4f;
    puff.rotation =
        glm::angleAxis(static_cast<float>(random.uniform(0, 3)), glm::normalize(glm::vec3(1, 2, 3)));
    puffs.push_back(puff);
    area += shape::extinctionArea(puff);
  }
  for (const int cells : {12, 40}) {
    const ExtinctionGrid grid(puffs, cells);
    EXPECT_NEAR(integral(grid, shape::boundsOf(puffs, 2)) / area, 1, 1e-3) << cells;
  }
}

TEST(ExtinctionGrid, ThereIsNothingOutside) {
  const std::vector puffs{ball({0, 0, 0}, 100, 0.02f)};
  const ExtinctionGrid grid(puffs, 30);
  EXPECT_EQ(grid.extinction({1000, 0, 0}), 0);
  EXPECT_EQ(grid.extinction({0, -1e6f, 0}), 0);
  EXPECT_GT(grid.extinction({0, 0, 0}), 0.015f);
}

TEST(ExtinctionGrid, GradientPointsIntoTheCloud) {
  const std::vector puffs{ball({0, 0, 0}, 100, 0.02f)};
  const ExtinctionGrid grid(puffs, 30);
  EXPECT_LT(grid.gradient({100, 0, 0}).x, 0);
  EXPECT_GT(grid.gradient({0, -100, 0}).y, 0);
}

TEST(ExtinctionGrid, NoPuffsAreNoCloud) {
  const ExtinctionGrid grid({}, 20);
  EXPECT_EQ(grid.extinction({0, 0, 0}), 0);
}

}  // namespace
}  // namespace cloudgen::light
