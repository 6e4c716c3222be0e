// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "motion/diffusion.hpp"
#include "motion/poisson.hpp"

namespace cloudgen::motion {
namespace {

Lattice randomLattice(const glm::ivec3& size) {
  base::RandomStream random(1, 2, base::Purpose::Test);
  Lattice lattice(size);
  for (float& value : lattice.values) value = static_cast<float>(random.uniform(-1, 1));
  return lattice;
}

/// Shares of waves are the values again, for lengths of all kinds of factors.
TEST(LineTransform, ThereAndBack) {
  for (const Ends ends : {Ends::Periodic, Ends::Walls})
    for (const int count : {2, 3, 4, 5, 7, 12, 20, 22, 40, 49, 100, 128}) {
      const Lattice before = randomLattice({kLanes, count, 1});
      Lattice after = before;
      const LineTransform transform(count, ends);
      transform.forward(after.values.data());
      transform.backward(after.values.data());
      for (std::size_t i = 0; i < before.values.size(); ++i)
        ASSERT_NEAR(after.values[i], before.values[i], 2e-6) << count;
    }
}

TEST(LineTransform, AWaveIsOneNumber) {
  constexpr int kCount = 20;
  Lattice wave({kLanes, kCount, 1});
  for (int i = 0; i < kCount; ++i)
    wave.at(3, i, 0) = static_cast<float>(std::cos(std::numbers::pi * 5 * (i + 0.5) / kCount));
  LineTransform(kCount, Ends::Walls).forward(wave.values.data());
  for (int i = 0; i < kCount; ++i) EXPECT_EQ(std::abs(wave.at(3, i, 0)) > 1e-5, i == 5) << i;
}

/// The second differences of the solution are what was given.
TEST(Poisson, SecondDifferencesAreThoseGiven) {
  for (const glm::ivec3& size :
       {glm::ivec3(100, 20, 40), glm::ivec3(7, 9, 11), glm::ivec3(40, 33, 2), glm::ivec3(64, 4, 36)}) {
    Lattice given = randomLattice(size);
    double mean = 0;
    for (const float value : given.values) mean += value / static_cast<double>(given.values.size());
    Lattice solution = given;
    Poisson(size).solve(solution);
    double worst = 0;
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
          const auto around = [&](int dx, int dy, int dz) {
            const int ny = y + dy;
            if (ny < 0 || ny >= size.y) return 0.0f;
            return solution.at((x + dx + size.x) % size.x, ny, (z + dz + size.z) % size.z) - solution.at(x, y, z);
          };
          const double differences = around(1, 0, 0) + around(-1, 0, 0) + around(0, 1, 0) + around(0, -1, 0) +
                                     around(0, 0, 1) + around(0, 0, -1);
          worst = std::max(worst, std::abs(differences - (given.at(x, y, z) - mean)));
        }
    EXPECT_LT(worst, 1e-4) << size.x << 'x' << size.y << 'x' << size.z;
  }
}

/// A wave decays by the factor of the implicit step; what walls hold stays; nothing overshoots.
TEST(RowDiffusion, WavesDecayAsTheyShould) {
  constexpr int kCount = 24;
  constexpr float kNumber = 30;
  const double second = 2 - 2 * std::cos(2 * std::numbers::pi * 2 / kCount),
               closed = 2 - 2 * std::cos(std::numbers::pi * 3 / kCount);
  Lattice periodic({kLanes, kCount, 1}), walls = periodic;
  for (int i = 0; i < kCount; ++i) {
    periodic.at(0, i, 0) = static_cast<float>(std::sin(2 * std::numbers::pi * 2 * i / kCount));
    walls.at(0, i, 0) = static_cast<float>(std::cos(std::numbers::pi * 3 * (i + 0.5) / kCount));
  }
  Lattice periodicAfter = periodic, wallsAfter = walls;
  RowDiffusion(kCount, Rim::Periodic, kNumber).step(periodicAfter.values.data());
  RowDiffusion(kCount, Rim::Closed, kNumber).step(wallsAfter.values.data());
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(periodicAfter.at(0, i, 0), periodic.at(0, i, 0) / (1 + kNumber * second), 1e-5);
    EXPECT_NEAR(wallsAfter.at(0, i, 0), walls.at(0, i, 0) / (1 + kNumber * closed), 1e-5);
  }
}

TEST(RowDiffusion, TheSumStaysAndTheMeanIsLeft) {
  for (const glm::ivec3& size : {glm::ivec3(9, 5, 6), glm::ivec3(2, 3, 40)}) {
    Lattice lattice = randomLattice(size);
    double before = 0, after = 0;
    for (const float value : lattice.values) before += value;
    diffuse(lattice, Rim::Closed, 1e5f);
    const double mean = before / static_cast<double>(lattice.values.size());
    for (const float value : lattice.values) {
      after += value;
      EXPECT_NEAR(value, mean, 0.02);
    }
    EXPECT_NEAR(after, before, 0.02 * std::max(1.0, std::abs(before)));
  }
}

}  // namespace
}  // namespace cloudgen::motion
