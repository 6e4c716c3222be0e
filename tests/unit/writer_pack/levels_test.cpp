// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/levels.hpp"

#include "support/pack_scene.hpp"

namespace cloudgen::writer::packed {
namespace {

double heldBy(std::span<const shape::Puff> puffs) {
  double sum = 0;
  for (const shape::Puff& puff : puffs) sum += shape::extinctionArea(puff);
  return sum;
}

TEST(Levels, GetCoarserAndSayByHowMuch) {
  for (const scene::Archetype& archetype : test::packScene().archetypes) {
    const auto levels = levelsOf(archetype);
    ASSERT_GE(levels.size(), 3u) << archetype.name;
    EXPECT_EQ(levels.front().puffs.size(), archetype.puffs.size());
    EXPECT_EQ(levels.front().errorMeters, 0);
    EXPECT_EQ(levels.back().puffs.size(), 1u);
    for (std::size_t l = 0; l < levels.size(); ++l) {
      EXPECT_EQ(levels[l].responses.size(), levels[l].puffs.size());
      if (l == 0) continue;
      EXPECT_LT(levels[l].puffs.size(), levels[l - 1].puffs.size());
      EXPECT_GT(levels[l].errorMeters, levels[l - 1].errorMeters);
      EXPECT_LT(levels[l].errorMeters, archetype.widthMeters);
    }
  }
}

TEST(Levels, MergedPuffsHoldAsMuch) {
  for (const scene::Archetype& archetype : test::packScene().archetypes) {
    const auto levels = levelsOf(archetype);
    EXPECT_NEAR(heldBy(levels[0].puffs) / heldBy(archetype.puffs), 1, 1e-3) << "widening keeps it";
    EXPECT_NEAR(heldBy(levels.back().puffs) / heldBy(archetype.puffs), 1, 1e-3);
  }
}

TEST(Levels, LightOfMergedPuffsIsTheMeanOfTheirs) {
  scene::Archetype archetype = test::packScene().archetypes[0];
  for (light::PuffResponse& response : archetype.response.puffs) response = {{0.5f, 0.25f}, {0.125f}, 0.6f, 0.3f, 1, 1};
  for (const Level& level : levelsOf(archetype))
    for (const light::PuffResponse& response : level.responses) {
      EXPECT_NEAR(response.sun[0], 0.5f, 1e-5f);
      EXPECT_NEAR(response.sun[1], 0.25f, 1e-5f);
      EXPECT_NEAR(response.forward[0], 0.125f, 1e-5f);
      EXPECT_NEAR(response.sky, 0.6f, 1e-5f);
      EXPECT_NEAR(response.ground, 0.3f, 1e-5f);
      EXPECT_NEAR(response.seen, 1, 1e-5f);
    }
}

}  // namespace
}  // namespace cloudgen::writer::packed
