// SPDX-License-Identifier: Apache-2.0
#include "motion/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/random.hpp"
#include "base/thread.hpp"
#include "support/fluid_divergence.hpp"

namespace cloudgen::motion {
namespace {

using test::greatestDivergence;

constexpr double kPi = std::numbers::pi;

Fluid restless(const glm::ivec3& cells, float cellMeters, double speed = 5) {
  Fluid fluid(cells, cellMeters);
  base::RandomStream random(7, 1, base::Purpose::Test);
  for (const int axis : {0, 1, 2}) {
    Lattice& velocity = fluid.velocity(axis);
    for (int z = 0; z < velocity.places.z; ++z)
      for (int y = 0; y < velocity.places.y; ++y)
        for (int x = 0; x < velocity.places.x; ++x)
          if (axis != 1 || (y > 0 && y < cells.y))
            velocity.at(x, y, z) = static_cast<float>(random.uniform(-speed, speed));
  }
  return fluid;
}

double energy(const Fluid& fluid) {
  double sum = 0;
  for (const int axis : {0, 1, 2})
    for (const float value : fluid.velocity(axis).values) sum += static_cast<double>(value) * value;
  return sum;
}

double sumOf(const Lattice& lattice) {
  double sum = 0;
  for (const float value : lattice.values) sum += value;
  return sum;
}

TEST(Fluid, ProjectionTakesOutSourcesAndSinks) {
  for (const glm::ivec3& cells : {glm::ivec3(100, 20, 40), glm::ivec3(100, 40, 40), glm::ivec3(31, 17, 22)}) {
    Fluid fluid = restless(cells, 50);
    const double before = greatestDivergence(fluid);
    fluid.project();
    EXPECT_LT(greatestDivergence(fluid), 1e-4 * before);
  }
}

/// What has no divergence stays as it is.
TEST(Fluid, ProjectionIsIdempotent) {
  Fluid fluid = restless({24, 16, 20}, 10);
  fluid.project();
  const Lattice once = fluid.velocity(0);
  fluid.project();
  for (std::size_t i = 0; i < once.values.size(); ++i) ASSERT_NEAR(fluid.velocity(0).values[i], once.values[i], 1e-4);
}

/// Taylor and Green 1937: vortices in two dimensions keep their form and decay by exp(-2 viscosity k^2 t).
double decayOfVortices(int vertical, double turns) {
  constexpr int kCells = 48;
  constexpr float kCell = 10, kSpeed = 1;
  const double length = kCells * kCell, wave = 2 * kPi / length;
  Fluid fluid(vertical == 1 ? glm::ivec3(kCells, kCells, 3) : glm::ivec3(kCells, 3, kCells), kCell);
  const auto at = [&](int cell, double offset) { return wave * kCell * (cell + offset); };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (int k = 0; k < 3; ++k) {
        const auto u = static_cast<float>(kSpeed * std::sin(at(i, 0)) * std::cos(at(j, 0.5))),
                   v = static_cast<float>(-kSpeed * std::cos(at(i, 0.5)) * std::sin(at(j, 0)));
        fluid.velocity(0).at(i, vertical == 1 ? j : k, vertical == 1 ? k : j) = u;
        if (vertical == 2) fluid.velocity(2).at(i, k, j) = v;
        if (vertical == 1 && j > 0) fluid.velocity(1).at(i, j, k) = v;
      }
  const double before = energy(fluid), seconds = turns * length / kSpeed;
  Forcing forcing;
  forcing.viscosity = static_cast<float>(1 / (4 * wave * wave * seconds));  // the energy falls to 1/e
  constexpr int kSteps = 100;
  for (int i = 0; i < kSteps; ++i) fluid.step(static_cast<float>(seconds / kSteps), forcing);
  return energy(fluid) / before;
}

TEST(Fluid, TaylorGreenVorticesDecayByViscosity) {
  EXPECT_NEAR(decayOfVortices(2, 1) * std::exp(1.0), 1, 0.03);
  EXPECT_NEAR(decayOfVortices(1, 1) * std::exp(1.0), 1, 0.03) << "between floor and lid";
}

TEST(Fluid, TheSumOfSmokeStays) {
  Fluid fluid = restless({40, 20, 30}, 20);
  fluid.project();
  fluid.smoke().at(20, 10, 15) = 100;
  fluid.smoke().at(3, 0, 0) = 5;
  for (int i = 0; i < 20; ++i) {
    fluid.step(6, {});
    EXPECT_NEAR(sumOf(fluid.smoke()), 105, 105 * 1e-4);
    EXPECT_GE(*std::min_element(fluid.smoke().values.begin(), fluid.smoke().values.end()), 0);
  }
}

TEST(Fluid, NoStepIsTooLong) {
  for (const float seconds : {1.0f, 100.0f, 1e4f, 1e6f}) {
    Fluid fluid = restless({20, 12, 16}, 30, 20);
    fluid.project();
    for (float& value : fluid.buoyancy().values) value = 0.1f;
    Forcing forcing;
    forcing.stability = 2e-4f;
    forcing.viscosity = 5;
    forcing.wind.assign(12, {8, -3});
    double most = 0;
    for (int i = 0; i < 30; ++i) {
      fluid.step(seconds, forcing);
      most = std::max(most, energy(fluid));
    }
    const double cells = 20 * 12 * 16, wind = 8 * 8 + 3 * 3;
    EXPECT_TRUE(std::isfinite(most));
    EXPECT_LT(energy(fluid), cells * (wind + 400)) << seconds;
  }
}

TEST(Fluid, SameBytesForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const base::ThreadLimit limit(threads);
    Fluid fluid = restless({33, 18, 21}, 25);
    fluid.smoke().at(4, 4, 4) = 3;
    Forcing forcing;
    forcing.viscosity = 3;
    forcing.stability = 1e-4f;
    forcing.wind.assign(18, {4, 1});
    forcing.heating.assign(fluid.buoyancy().values.size(), 1e-4f);
    for (int i = 0; i < 3; ++i) fluid.step(20, forcing);
    return fluid;
  };
  Fluid one = run(1), four = run(4);
  for (const int axis : {0, 1, 2}) EXPECT_EQ(one.velocity(axis).values, four.velocity(axis).values);
  EXPECT_EQ(one.smoke().values, four.smoke().values);
  EXPECT_EQ(one.buoyancy().values, four.buoyancy().values);
}

TEST(Fluid, WarmAirRisesInTheMiddleAndSinksAround) {
  Fluid fluid({24, 24, 24}, 50);
  Forcing forcing;
  forcing.heating.assign(fluid.buoyancy().values.size(), 0.0f);
  for (int z = 10; z < 14; ++z)
    for (int y = 4; y < 8; ++y)
      for (int x = 10; x < 14; ++x) forcing.heating[fluid.buoyancy().index(x, y, z)] = 1e-3f;
  for (int i = 0; i < 30; ++i) fluid.step(5, forcing);
  EXPECT_GT(fluid.velocityAt({600, 400, 600}).y, 0.5);
  EXPECT_LT(fluid.velocityAt({50, 400, 50}).y, 0);
}

/// Air that is lifted in stable air swings at the Brunt-Vaisala frequency where it is in tall columns.
TEST(Fluid, StableAirSwings) {
  Fluid fluid({64, 4, 2}, 50);
  fluid.project();
  Forcing forcing;
  forcing.stability = 1e-4f;
  for (int y = 1; y < 4; ++y)
    for (int z = 0; z < 2; ++z)
      for (int x = 0; x < 64; ++x)
        fluid.velocity(1).at(x, y, z) = static_cast<float>(1e-3 * std::sin(kPi * y / 4) * (x % 2 == 0 ? 1 : -1));
  double before = 1, seconds = 0;
  while (seconds < 1000) {
    fluid.step(1, forcing);
    seconds += 1;
    const double now = fluid.velocity(1).at(0, 2, 0);
    if (before > 0 && now <= 0) break;
    before = now;
  }
  // omega^2 = N^2 kx^2 / (kx^2 + ky^2) of the differences: kx^2 = 4, ky^2 = 2 - 2 cos(pi / 4); linear means between
  // faces and middles count cos^2(pi / 8).
  const double kx = 4, ky = 2 - 2 * std::cos(kPi / 4), mean = std::pow(std::cos(kPi / 8), 2);
  const double quarter = kPi / 2 / (0.01 * std::sqrt(mean * kx / (kx + ky)));
  EXPECT_NEAR(seconds, quarter, 0.03 * quarter);
}

TEST(Fluid, LevelsTakeTheWindOfTheModel) {
  Fluid fluid({16, 8, 16}, 100);
  Forcing forcing;
  forcing.windSeconds = 60;
  for (int y = 0; y < 8; ++y) forcing.wind.emplace_back(2.0f * static_cast<float>(y), -1.0f);
  for (int i = 0; i < 40; ++i) fluid.step(20, forcing);
  for (int y = 0; y < 8; ++y) {
    const glm::vec3 wind = fluid.velocityAt({830, 100.0f * (static_cast<float>(y) + 0.5f), 420});
    EXPECT_NEAR(wind.x, 2 * y, 0.02);
    EXPECT_NEAR(wind.z, -1, 0.02);
    EXPECT_NEAR(wind.y, 0, 0.01);
  }
}

}  // namespace
}  // namespace cloudgen::motion
