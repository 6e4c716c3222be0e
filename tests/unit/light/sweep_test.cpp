// SPDX-License-Identifier: Apache-2.0
#include "light/sweep.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "support/ball.hpp"
#include "support/ray_march.hpp"

namespace cloudgen::light {
namespace {

std::vector<shape::Puff> randomPuffs() {
  base::RandomStream random(3, 8, base::Purpose::Test);
  std::vector<shape::Puff> puffs(150);
  for (shape::Puff& puff : puffs) {
    puff.center = {random.uniform(-600, 600), random.uniform(0, 900), random.uniform(-500, 500)};
    puff.sigma = glm::vec3(random.uniform(140, 240), random.uniform(120, 180), random.uniform(140, 240));
    puff.extinctionPerMeter = 0.01f;
  }
  return puffs;
}

struct Difference {
  double relative = 0;  ///< root of the mean squares, of difference to depth
  double worstTransmittance = 0;
};

Difference againstMarching(const ExtinctionGrid& grid, const glm::vec3& direction) {
  DepthSweep sweep(grid);
  sweep.towards(direction);
  const glm::ivec3 size = grid.size();
  double squares = 0, norm = 0;
  Difference found;
  for (int z = 0; z < size.z; z += 2)
    for (int y = 0; y < size.y; y += 2)
      for (int x = 0; x < size.x; x += 2) {
        const auto cell = static_cast<std::size_t>((z * size.y + y) * size.x + x);
        const double swept = sweep.cells()[cell],
                     marched = test::marchedDepth(grid, test::cellCenter(grid, x, y, z), direction);
        squares += (swept - marched) * (swept - marched);
        norm += marched * marched;
        found.worstTransmittance =
            std::max(found.worstTransmittance, std::abs(std::exp(-0.15 * swept) - std::exp(-0.15 * marched)));
      }
  found.relative = std::sqrt(squares / norm);
  return found;
}

TEST(Sweep, DepthsAreThoseOfARayForEveryCell) {
  const auto puffs = randomPuffs();
  const ExtinctionGrid grid(puffs, 40);
  for (const glm::vec3& towards :
       {glm::vec3(0, 1, 0), glm::vec3(1, 0.3f, 0), glm::vec3(-0.3f, 0.4f, 0.9f), glm::vec3(0.2f, -1, -0.5f),
        glm::vec3(1, 1, 1), glm::vec3(-1, 0.02f, -1), glm::vec3(0, 0, -1)}) {
    const Difference found = againstMarching(grid, glm::normalize(towards));
    EXPECT_LT(found.relative, 0.02) << towards.x << ' ' << towards.y << ' ' << towards.z;
    EXPECT_LT(found.worstTransmittance, 0.06) << towards.x << ' ' << towards.y << ' ' << towards.z;
  }
}

TEST(Sweep, GoesThroughABallAsKnown) {
  const shape::Puff puff = test::ball({50, 60, 70}, 100, 0.02f);
  const std::vector puffs{puff};
  const ExtinctionGrid grid(puffs, 40);
  DepthSweep sweep(grid);
  const double expected = 0.02 * 100 * std::sqrt(2 * M_PI);
  for (const glm::vec3& towards : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
    sweep.towards(towards);
    EXPECT_NEAR(sweep.at(puff.center), 0.5 * expected, 0.07 * expected);
    EXPECT_LT(sweep.at(puff.center + 180.0f * towards), 0.1 * expected);
    EXPECT_NEAR(sweep.at(puff.center - 180.0f * towards), expected, 0.15 * expected);
    EXPECT_EQ(sweep.at(puff.center + 5000.0f * towards), 0);
  }
}

TEST(Sweep, NoPuffsAreNoDepth) {
  const ExtinctionGrid grid({}, 20);
  DepthSweep sweep(grid);
  sweep.towards({0, 1, 0});
  EXPECT_EQ(sweep.at({0, 0, 0}), 0);
}

}  // namespace
}  // namespace cloudgen::light
