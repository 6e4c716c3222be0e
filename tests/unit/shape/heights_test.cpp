// SPDX-License-Identifier: Apache-2.0
#include "shape/heights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace cloudgen::shape {
namespace {

constexpr double kDepthMeters = 1000;

/// Nine round puffs one above the other.
std::vector<Puff> stack() {
  std::vector<Puff> puffs;
  for (int i = 0; i < 9; ++i) {
    Puff puff;
    puff.center.y = 100.0f * static_cast<float>(i + 1);
    puff.sigma = glm::vec3(200);
    puff.extinctionPerMeter = 0.1f;
    puffs.push_back(puff);
  }
  return puffs;
}

double wholeArea(const std::vector<Puff>& puffs) {
  double whole = 0;
  for (const Puff& puff : puffs) whole += extinctionArea(puff);
  return whole;
}

/// Share of the extinction above a height.
double shareAbove(const std::vector<Puff>& puffs, double heightMeters) {
  double above = 0;
  for (const Puff& puff : puffs)
    above += extinctionArea(puff) * 0.5 *
             std::erfc((heightMeters - puff.center.y) / (puff.sigma.y * std::numbers::sqrt2));
  return above / wholeArea(puffs);
}

TEST(Heights, SpreadPuffsBeginAndEndWhereTheLayerDoes) {
  for (const Ends ends : {Ends::Round, Ends::Flat}) {
    std::vector<Puff> puffs = stack();
    spreadBetween(puffs, 0.05, kDepthMeters, ends);
    EXPECT_NEAR(heightOfShare(puffs, 0.05), 50, 30);
    EXPECT_NEAR(heightOfShare(puffs, 0.95), 950, 30);
    EXPECT_NEAR(wholeArea(puffs) / wholeArea(stack()), 1, 1e-3);
  }
}

// An optical depth of a hundred must not be seen as cloud of 0.1 a little above its top.
TEST(Heights, FlatEndsLeaveNothingBeyond) {
  std::vector<Puff> round = stack(), flat = stack();
  spreadBetween(round, 0.05, kDepthMeters, Ends::Round);
  spreadBetween(flat, 0.05, kDepthMeters, Ends::Flat);
  EXPECT_LT(shareAbove(flat, 1.1 * kDepthMeters), 1e-3);
  EXPECT_LT(shareAbove(flat, 1.1 * kDepthMeters), 0.1 * shareAbove(round, 1.1 * kDepthMeters));
}

TEST(Heights, GatheredPuffsBeginAndEndWhereTheyDid) {
  for (const double middle : {0.2, 0.35, 0.65, 0.8}) {
    std::vector<Puff> puffs = stack();
    gatherAt(puffs, middle, 0.05);
    spreadBetween(puffs, 0.05, kDepthMeters, Ends::Round);
    EXPECT_NEAR((heightOfShare(puffs, 0.5) - 50) / 900, middle, 0.06);
    EXPECT_NEAR(heightOfShare(puffs, 0.05), 50, 30);
    EXPECT_NEAR(heightOfShare(puffs, 0.95), 950, 30);
    EXPECT_NEAR(wholeArea(puffs) / wholeArea(stack()), 1, 1e-3);
  }
}

}  // namespace
}  // namespace cloudgen::shape
