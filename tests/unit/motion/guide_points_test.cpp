// SPDX-License-Identifier: Apache-2.0
#include "motion/guide_points.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"

namespace cloudgen::motion {
namespace {

std::vector<shape::Puff> heap() {
  base::RandomStream random(5, 5, base::Purpose::Test);
  std::vector<shape::Puff> puffs(40);
  for (shape::Puff& puff : puffs) {
    puff.center = {random.uniform(-500, 500), random.uniform(50, 600), random.uniform(-500, 500)};
    puff.sigma = glm::vec3(random.uniform(80, 160));
    puff.extinctionPerMeter = 0.02f;
  }
  return puffs;
}

TEST(GuidePoints, GoWithTheWind) {
  Fluid fluid({20, 10, 20}, 100);
  for (float& u : fluid.velocity(0).values) u = 7;
  std::vector<glm::vec3> places{{100, 500, 300}, {1950, 20, 1000}};
  for (int i = 0; i < 10; ++i) carryPoints(fluid, 5, places);
  EXPECT_NEAR(places[0].x, 100 + 350, 0.01);
  EXPECT_NEAR(places[1].x, 1950 + 350, 0.01) << "places are not wrapped";
  EXPECT_NEAR(places[0].y, 500, 1e-3);
}

/// In a circling flow a point stays on its circle.
TEST(GuidePoints, StayOnTheirStreamline) {
  Fluid fluid({64, 4, 64}, 10);
  for (int z = 0; z < 64; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 64; ++x) {
        fluid.velocity(0).at(x, y, z) = -0.01f * (10 * (static_cast<float>(z) + 0.5f) - 320);
        fluid.velocity(2).at(x, y, z) = 0.01f * (10 * (static_cast<float>(x) + 0.5f) - 320);
      }
  std::vector<glm::vec3> places{{420, 20, 320}};
  for (int i = 0; i < 100; ++i) carryPoints(fluid, 6.2831853f, places);
  EXPECT_NEAR(glm::distance(places[0], glm::vec3(420, 20, 320)), 0, 1);
}

TEST(IdleLoop, MovesAndClosesSmoothly) {
  const auto puffs = heap();
  constexpr int kSteps = 24;
  const IdleLoop loop = idleLoop(puffs, {1.5f, {4, 0}, 1e-4f}, 240, kSteps);
  ASSERT_EQ(loop.shifts.size(), static_cast<std::size_t>(kSteps));
  const auto between = [&](std::size_t i) {
    const auto &a = loop.shifts[i % kSteps], &b = loop.shifts[(i + 1) % kSteps];
    double sum = 0;
    for (std::size_t p = 0; p < puffs.size(); ++p) sum += glm::length(b[p] - a[p]);
    return sum / static_cast<double>(puffs.size());
  };
  std::vector<double> ways;
  for (std::size_t i = 0; i < kSteps; ++i) ways.push_back(between(i));
  const double most = *std::max_element(ways.begin(), ways.end());
  EXPECT_GT(most, 1) << "metres a step";
  EXPECT_LE(ways.back(), most);
  // No jump in speed at the seam either.
  double atSeam = 0, within = 0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    double change = 0;
    for (std::size_t p = 0; p < puffs.size(); ++p)
      change += glm::length(loop.shifts[(i + 2) % kSteps][p] - 2.0f * loop.shifts[(i + 1) % kSteps][p] + loop.shifts[i][p]);
    (i + 1 == kSteps ? atSeam : within) = std::max(i + 1 == kSteps ? atSeam : within, change);
  }
  EXPECT_LT(atSeam, 1.5 * within);
  for (const auto& shifts : loop.shifts)
    for (std::size_t p = 0; p < puffs.size(); ++p) EXPECT_LT(glm::length(shifts[p]), 0.7f * puffs[p].sigma.x);
}

TEST(IdleLoop, IsTheSameEveryTime) {
  const auto puffs = heap();
  EXPECT_EQ(idleLoop(puffs, {}, 100, 8).shifts, idleLoop(puffs, {}, 100, 8).shifts);
}

}  // namespace
}  // namespace cloudgen::motion
