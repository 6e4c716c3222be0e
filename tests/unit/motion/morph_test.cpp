// SPDX-License-Identifier: Apache-2.0
#include "motion/morph.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/random.hpp"

namespace cloudgen::motion {
namespace {

/// A heap of a size; puffs that fill a half ball.
std::vector<shape::Puff> heap(int count, float size, std::uint64_t seed) {
  base::RandomStream random(seed, 1, base::Purpose::Test);
  std::vector<shape::Puff> puffs;
  while (static_cast<int>(puffs.size()) < count) {
    const glm::vec3 at(random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1));
    if (glm::length(at) > 1) continue;
    shape::Puff puff;
    puff.center = size * at;
    puff.sigma = size * glm::vec3(random.uniform(0.1, 0.2), random.uniform(0.1, 0.2), random.uniform(0.1, 0.2));
    puff.rotation = glm::angleAxis(static_cast<float>(random.uniform(0, 3)), glm::vec3(random.direction()));
    puff.extinctionPerMeter = 20 / size;
    puffs.push_back(puff);
  }
  return puffs;
}

double water(std::span<const shape::Puff> puffs) {
  double sum = 0;
  for (const shape::Puff& puff : puffs) sum += shape::extinctionArea(puff);
  return sum;
}

/// The ground under more than an optical depth of 0.1, by a raster; puffs as balls.
double silhouette(std::span<const shape::Puff> puffs) {
  double covered = 0;
  for (float x = -2500; x < 2500; x += 50)
    for (float z = -2500; z < 2500; z += 50) {
      double depth = 0;
      for (const shape::Puff& puff : puffs) {
        const double s = std::cbrt(puff.sigma.x * puff.sigma.y * puff.sigma.z);
        const double dx = x - puff.center.x, dz = z - puff.center.z;
        depth += shape::extinctionArea(puff) / (2 * 3.14159265 * s * s) * std::exp(-0.5 * (dx * dx + dz * dz) / (s * s));
      }
      covered += depth > 0.1;
    }
  return covered;
}

TEST(Morph, EveryPuffHasAPartnerAndGoesWhole) {
  for (const auto& [a, b] : {std::pair(60, 150), std::pair(150, 60), std::pair(80, 80)}) {
    const auto from = heap(a, 500, 1), to = heap(b, 1500, 2);
    const auto pairs = matchPuffs(from, to);
    std::vector<double> fromShares(from.size()), toShares(to.size());
    for (const PuffPair& pair : pairs) fromShares[pair.from] += pair.fromShare, toShares[pair.to] += pair.toShare;
    for (const double share : fromShares) EXPECT_NEAR(share, 1, 1e-5);
    for (const double share : toShares) EXPECT_NEAR(share, 1, 1e-5);
  }
}

TEST(Morph, TheSamePuffsAreMatchedWithThemselves) {
  const auto from = heap(100, 500, 3);
  auto to = from;
  for (shape::Puff& puff : to) puff.center *= glm::vec3(3, 2, 1);
  for (const PuffPair& pair : matchPuffs(from, to)) EXPECT_EQ(pair.from, pair.to);
}

TEST(Morph, WaterAndSilhouetteGoOneWay) {
  const auto from = heap(70, 600, 4), to = heap(120, 1500, 5);
  const auto pairs = matchPuffs(from, to);
  EXPECT_NEAR(water(morphed(from, to, pairs, 0)) / water(from), 1, 1e-4);
  EXPECT_NEAR(silhouette(morphed(from, to, pairs, 1)) / silhouette(to), 1, 0.01);
  double waterBefore = 0, silhouetteBefore = 0;
  for (float share = 0; share <= 1.001f; share += 0.125f) {
    const auto puffs = morphed(from, to, pairs, share);
    EXPECT_NEAR(water(puffs) / ((1 - share) * water(from) + share * water(to)), 1, 1e-3);
    EXPECT_GE(water(puffs), waterBefore);
    EXPECT_GE(silhouette(puffs), 0.99 * silhouetteBefore) << share;
    waterBefore = water(puffs), silhouetteBefore = silhouette(puffs);
  }
}

TEST(Morph, NothingBecomesNothing) {
  EXPECT_TRUE(matchPuffs({}, heap(3, 100, 1)).empty());
  EXPECT_TRUE(matchPuffs(heap(3, 100, 1), {}).empty());
}

}  // namespace
}  // namespace cloudgen::motion
