// SPDX-License-Identifier: Apache-2.0
#include "base/random.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

#include "base/thread.hpp"

namespace cloudgen::base {
namespace {

TEST(RandomStream, TheSameAddressGivesTheSameNumbers) {
  RandomStream a(7, 42, Purpose::Test, 3), b(7, 42, Purpose::Test, 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(RandomStream, EveryPartOfTheAddressCounts) {
  const std::uint64_t first = RandomStream(7, 42, Purpose::Test, 3).bits();
  EXPECT_NE(first, RandomStream(8, 42, Purpose::Test, 3).bits());
  EXPECT_NE(first, RandomStream(7, 43, Purpose::Test, 3).bits());
  EXPECT_NE(first, RandomStream(7, 42, Purpose::CloudSize, 3).bits());
  EXPECT_NE(first, RandomStream(7, 42, Purpose::Test, 4).bits());
}

/// Pinned: these numbers place every cloud of every scene that was ever made, so they must not change.
TEST(RandomStream, GoldenValues) {
  RandomStream stream(1, 2, Purpose::Test, 3);
  const std::uint64_t expected[] = {0xcf77c22000b3487du, 0x67b5b42c8b506947u, 0xb00ed50a5975c476u,
                                    0x639958eb57ca626bu, 0x7ba90223ba438bcfu, 0xd31bd601f56a23f9u};
  for (const std::uint64_t value : expected) EXPECT_EQ(stream.bits(), value);
}

TEST(RandomStream, IsUniform) {
  RandomStream stream(1, 1, Purpose::Test);
  constexpr int kDraws = 200000, kBins = 20;
  double sum = 0, squares = 0;
  std::vector<int> bins(kBins);
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u, squares += u * u, ++bins[static_cast<std::size_t>(u * kBins)];
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.003);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 0.003);
  for (const int bin : bins) EXPECT_NEAR(bin, kDraws / kBins, 400);
}

TEST(RandomStream, FirstDrawsOfNeighbouringCellsAreUnrelated) {
  constexpr int kCells = 20000;
  double product = 0, mean = 0;
  for (int cell = 0; cell < kCells; ++cell) {
    const double a = RandomStream(1, cell, Purpose::CloudPlace).uniform(),
                 b = RandomStream(1, cell + 1, Purpose::CloudPlace).uniform();
    mean += a / kCells, product += (a - 0.5) * (b - 0.5) / kCells;
  }
  EXPECT_NEAR(mean, 0.5, 0.01);
  EXPECT_NEAR(product * 12, 0, 0.03) << "correlation";
}

TEST(RandomStream, GaussianAndDirectionHaveTheirMoments) {
  RandomStream stream(1, 5, Purpose::Test);
  constexpr int kDraws = 100000;
  double mean = 0, variance = 0;
  glm::dvec3 drift(0);
  for (int i = 0; i < kDraws; ++i) {
    const double g = stream.gaussian();
    mean += g / kDraws, variance += g * g / kDraws;
    const glm::dvec3 d = stream.direction();
    ASSERT_NEAR(glm::length(d), 1, 1e-12);
    drift += d / static_cast<double>(kDraws);
  }
  EXPECT_NEAR(mean, 0, 0.015);
  EXPECT_NEAR(variance, 1, 0.02);
  EXPECT_LT(glm::length(drift), 0.015);
}

TEST(RandomStream, IndexStaysInRange) {
  RandomStream stream(1, 6, Purpose::Test);
  std::vector<int> seen(7);
  for (int i = 0; i < 7000; ++i) ++seen.at(static_cast<std::size_t>(stream.index(7)));
  for (const int count : seen) EXPECT_NEAR(count, 1000, 150);
}

TEST(ParallelFor, ThreadsDoNotChangeTheResult) {
  const auto draw = [](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> values(1000);
    parallelFor(values.size(),
                [&](std::size_t i) { values[i] = RandomStream(9, i, Purpose::Test).uniform(); });
    return values;
  };
  EXPECT_EQ(draw(1), draw(4));
}

}  // namespace
}  // namespace cloudgen::base
