// SPDX-License-Identifier: Apache-2.0
// What an observer demands of each form, in numbers.
#include "shape/forms.hpp"

#include <algorithm>
#include <cmath>

#include "support/all_recipes.hpp"

namespace cloudgen::shape {
namespace {

CloudShape shaped(base::Genus genus, double widthMeters, double depthMeters, int puffs, bool even = false) {
  ShapeRequest wanted{widthMeters, depthMeters, 20, 0, puffs, 5, 0};
  wanted.even = even;
  return generate(test::recipeOf(genus), wanted);
}

/// Extinction of puffs whose centres a question picks, as a share of all.
template <class Question>
double share(const CloudShape& cloud, Question&& asked) {
  double picked = 0, all = 0;
  for (const Puff& puff : cloud.puffs) {
    all += extinctionArea(puff);
    if (asked(puff)) picked += extinctionArea(puff);
  }
  return picked / all;
}

TEST(Forms, TurretsNarrowAsTheyRise) {
  base::RandomStream stream(3, 1, base::Purpose::Test);
  std::vector<Lobe> lobes;
  raiseTurret(lobes, {{0, 10, 0}, 100, 0, 0, {0, 1, 0}}, 800, 0, stream);
  ASSERT_GT(lobes.size(), 4u);
  for (std::size_t i = 0; i + 1 < lobes.size(); ++i) {
    EXPECT_GT(lobes[i + 1].center.y, lobes[i].center.y);
    EXPECT_LT(lobes[i + 1].radius, 1.25 * lobes[i].radius);
  }
  EXPECT_LT(lobes.back().radius, 0.8 * lobes.front().radius);
  EXPECT_NEAR(lobes.back().center.y + lobes.back().radius, 800, 80);
}

TEST(Forms, LobesAreDrawnToTheHeightAsAWhole) {
  std::vector<Lobe> lobes{{{0, 100, 0}, 50}, {{0, 200, 0}, 60}, {{0, 300, 0}, 20}};
  reachTo(lobes, 640);
  EXPECT_NEAR(lobes[2].center.y, 620, 1e-6);
  EXPECT_NEAR(lobes[1].center.y / lobes[0].center.y, 2, 1e-6);
}

TEST(Forms, CumulusHasABroadFootAndANarrowTop) {
  const CloudShape cloud = shaped(base::Genus::Cumulus, 1500, 1500, 4000);
  const auto spread = [&](double from, double to) {
    double square = 0, area = 0;
    for (const Puff& puff : cloud.puffs) {
      if (puff.center.y < from * 1500 || puff.center.y >= to * 1500) continue;
      square += extinctionArea(puff) * (puff.center.x * puff.center.x + puff.center.z * puff.center.z);
      area += extinctionArea(puff);
    }
    return std::sqrt(square / area);
  };
  EXPECT_GT(spread(0, 0.2), 1.2 * spread(0.6, 1.0));
  // All of it stands on one level.
  EXPECT_GT(share(cloud, [](const Puff& puff) { return puff.center.y < 0.08 * 1500; }), 0.03);
}

TEST(Forms, TheAnvilOverhangsDownwindAndThinsThere) {
  const double width = 20000, depth = 11000;
  const CloudShape cloud = shaped(base::Genus::Cumulonimbus, width, depth, 4000);
  double column = 0, weight = 0;
  for (const Puff& puff : cloud.puffs)
    if (puff.center.y > 0.2 * depth && puff.center.y < 0.6 * depth)
      column += extinctionArea(puff) * puff.center.x, weight += extinctionArea(puff);
  column /= weight;
  double upwind = 0, downwind = 0;
  for (const Puff& puff : cloud.puffs)
    if (puff.center.y > 0.8 * depth)
      upwind = std::max<double>(upwind, column - puff.center.x),
      downwind = std::max<double>(downwind, puff.center.x - column);
  EXPECT_GT(downwind, 2.5 * upwind);
  const auto between = [&](double from, double to) {
    return share(cloud, [&](const Puff& puff) {
      return puff.center.y > 0.6 * depth && puff.center.x - column > from * width &&
             puff.center.x - column < to * width;
    });
  };
  EXPECT_GT(between(0.15, 0.3), 2 * between(0.45, 0.6));
  EXPECT_GT(between(0.45, 0.6), 0);
}

TEST(Forms, TheDomeStandsOverTheAnvil) {
  const double width = 20000, depth = 11000;
  const CloudShape cloud = shaped(base::Genus::Cumulonimbus, width, depth, 4000);
  double dome = 0, anvil = 0;
  for (const Puff& puff : cloud.puffs) {
    const bool ofAnvil = puff.sigma.x > 1.5f * puff.sigma.y && puff.center.y > 0.75 * depth;
    double& top = ofAnvil ? anvil : dome;
    top = std::max<double>(top, puff.center.y + puff.sigma.y);
  }
  EXPECT_GT(dome, anvil + 0.06 * depth);
  EXPECT_GT(anvil, 0.8 * depth);
}

TEST(Forms, NothingLargeIsRoundInCirrus) {
  for (const bool even : {false, true})
    for (const Puff& puff : shaped(base::Genus::Cirrus, 10000, 1000, 600, even).puffs)
      if (puff.sigma.x > 150) {
        ASSERT_GT(puff.sigma.x, 1.9f * puff.sigma.z);
      }
}

constexpr int kAcross = 40;

/// Puffs over each of 40 by 40 squares of the middle half of a cloud.
std::vector<int> puffsOnSquares(const CloudShape& cloud, double width) {
  std::vector<int> puffs(kAcross * kAcross);
  for (const Puff& puff : cloud.puffs) {
    const int x = static_cast<int>((puff.center.x / width + 0.25) * 2 * kAcross),
              z = static_cast<int>((puff.center.z / width + 0.25) * 2 * kAcross);
    if (std::min(x, z) >= 0 && std::max(x, z) < kAcross) ++puffs[static_cast<std::size_t>(z * kAcross + x)];
  }
  return puffs;
}

TEST(Forms, StratocumulusHasLanes) {
  const double width = 15000;
  const CloudShape cloud = shaped(base::Genus::Stratocumulus, width, 700, 6000);
  // Of small squares in the middle some are empty, most are not.
  const std::vector<int> puffs = puffsOnSquares(cloud, width);
  const double empty = static_cast<double>(std::count(puffs.begin(), puffs.end(), 0)) / (kAcross * kAcross);
  EXPECT_GT(empty, 0.05);
  EXPECT_LT(empty, 0.5);
}

// Across the wind a roll goes on where cells would end.
TEST(Forms, CellsAreJoinedIntoRolls) {
  Recipe recipe = test::recipeOf(base::Genus::Stratocumulus);
  const double width = 15000;
  const auto crossings = [&](float rolls) {
    recipe.waves = rolls;
    const CloudShape cloud = generate(recipe, {width, 700, 20, 0, 6000, 5, 0});
    const std::vector<int> puffs = puffsOnSquares(cloud, width);
    // How often a border between cloud and none is crossed: along the rolls, and across.
    int along = 0, across = 0;
    for (int z = 0; z + 1 < kAcross; ++z)
      for (int x = 0; x + 1 < kAcross; ++x) {
        const auto at = [&](int i, int k) { return puffs[static_cast<std::size_t>(k * kAcross + i)] > 0; };
        along += at(x, z) != at(x, z + 1);
        across += at(x, z) != at(x + 1, z);
      }
    return static_cast<double>(along) / across;
  };
  EXPECT_LT(crossings(1), 0.8 * crossings(0));
}

TEST(Forms, CastellanusStandsOverItsLayer) {
  Recipe recipe = test::recipeOf(base::Genus::Altocumulus);
  const ShapeRequest wanted{12000, 600, 5, 0, 4000, 5, 0};
  const auto high = [&] {
    return share(generate(recipe, wanted), [](const Puff& puff) { return puff.center.y > 0.7 * 600; });
  };
  const double flat = high();
  recipe.turrets = 0.15f;
  EXPECT_GT(high(), 0);
  EXPECT_LT(high(), 0.7 * flat);
}

}  // namespace
}  // namespace cloudgen::shape
