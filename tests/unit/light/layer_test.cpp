// SPDX-License-Identifier: Apache-2.0
#include "light/layer.hpp"

#include <cmath>

#include "light/optics.hpp"
#include "light/transfer.hpp"
#include "support/ball.hpp"

namespace cloudgen::light {
namespace {

/// A level sheet of puffs that thins out towards its rim, as elements of a deck do.
std::vector<shape::Puff> element(float flattening) {
  std::vector<shape::Puff> puffs;
  for (float z = -2000; z <= 2000; z += 200)
    for (float y = 0; y <= 1000; y += 100)
      for (float x = -2000; x <= 2000; x += 200) {
        shape::Puff puff = test::ball({x, y, z}, 150, 0.02f * std::exp(-(x * x + z * z) / 1.5e6f));
        puff.sigma.y *= flattening;
        puffs.push_back(puff);
      }
  return puffs;
}

TEST(Layer, AnEvenSlabHasItsDepth) {
  std::vector<shape::Puff> puffs;
  for (float z = -3000; z <= 3000; z += 100)
    for (float y = 0; y < 500; y += 100)
      for (float x = -3000; x <= 3000; x += 100) puffs.push_back(test::ball({x, y, z}, 70, 0.01f));
  const double vertical = 5 * shape::extinctionArea(puffs[0]) / (100 * 100);
  const Layer layer(ExtinctionGrid(puffs, 60));
  EXPECT_NEAR(layer.depthFrom(-1000, 1) / vertical, 1, 0.04);
  EXPECT_NEAR(layer.depthFrom(200, 1) / vertical, 0.5, 0.04);
  EXPECT_NEAR(layer.depthFrom(200, -0.5f) / vertical, 1, 0.06);
  EXPECT_EQ(layer.depthFrom(5000, 1), 0);
}

TEST(Layer, WideCloudsOfFlatPuffsAreParts) {
  const auto flat = element(0.2f), round = element(0.9f);
  EXPECT_GT(layerShare(flat, ExtinctionGrid(flat, 40)), 0.5f);
  EXPECT_EQ(layerShare(round, ExtinctionGrid(round, 40)), 0);
}

// At the rim of an element others go on: it is as dark below as the middle, whatever comes in from the side.
TEST(Layer, TheRimIsAsDarkBelowAsTheMiddle) {
  const auto puffs = element(0.2f);
  const auto answers = bakeSun(puffs, ExtinctionGrid(puffs, 50), kWaterAsymmetry, {0.8f, 0.6f, 0});
  float middle = 0, rim = 0;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    if (puffs[i].center.y > 0 || puffs[i].center.z != 0) continue;
    if (puffs[i].center.x == 0) middle = answers[i].sun;
    if (puffs[i].center.x == 1800) rim = answers[i].sun;
  }
  EXPECT_GT(middle, 0);
  EXPECT_LT(rim, 1.6f * middle);
}

}  // namespace
}  // namespace cloudgen::light
