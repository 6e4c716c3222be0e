// SPDX-License-Identifier: Apache-2.0
#include "pipeline/budget_search.hpp"

#include <gtest/gtest.h>

namespace cloudgen::pipeline {
namespace {

constexpr double kAllowed = 20'000;

/// The best share of so many attempts, of a sky that draws `puffs` of a budget.
template <class Puffs>
double bestOf(int attempts, Puffs puffs) {
  BudgetSearch search(kAllowed);
  DrawnShare best;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const DrawnShare drawn{puffs(search.budget()) / kAllowed};
    if (attempt == 0 || drawn.isNearerThan(best)) best = drawn;
    if (drawn.isNear()) break;
    search.drew(drawn);
  }
  return best.share;
}

TEST(BudgetSearch, FindsWhatIsAllowedWherePuffsFollowTheBudget) {
  for (const double perBudget : {0.01, 0.3, 1.0, 4.0, 50.0}) {
    const double share = bestOf(4, [&](double budget) { return perBudget * budget; });
    EXPECT_GT(share, 0.6) << perBudget;
    EXPECT_LT(share, 1.25) << perBudget;
  }
}

TEST(BudgetSearch, DrawsTooFewRatherThanTooManyWherePuffsJump) {
  for (const double jump : {0.4, 0.9, 1.6, 3.0})
    EXPECT_NEAR(bestOf(7, [&](double budget) { return budget < jump * kAllowed ? 8'500 : 67'000; }), 0.425, 1e-9)
        << jump;
}

TEST(BudgetSearch, FindsANarrowStepBetweenTwoJumps) {
  EXPECT_NEAR(bestOf(7, [](double budget) { return budget < 17'000 ? 4'000 : budget < 21'000 ? 18'000 : 70'000; }), 0.9,
              1e-9);
  EXPECT_NEAR(bestOf(7, [](double budget) { return budget < 25'000 ? 4'000 : budget < 31'000 ? 18'000 : 70'000; }), 0.9,
              1e-9);
}

}  // namespace
}  // namespace cloudgen::pipeline
