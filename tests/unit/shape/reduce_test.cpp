// SPDX-License-Identifier: Apache-2.0
#include "shape/reduce.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/random.hpp"

namespace cloudgen::shape {
namespace {

std::vector<Puff> crowd(int count) {
  base::RandomStream random(1, 2, base::Purpose::Test);
  std::vector<Puff> puffs;
  for (int i = 0; i < count; ++i) {
    Puff puff;
    puff.center = glm::dvec3(random.uniform(-900, 900), random.uniform(0, 500), random.uniform(-300, 300));
    puff.sigma = glm::dvec3(random.uniform(20, 90), random.uniform(10, 40), random.uniform(20, 60));
    puff.rotation = glm::angleAxis(static_cast<float>(random.uniform(0, 6)),
                                   glm::vec3(glm::normalize(random.direction())));
    puff.extinctionPerMeter = static_cast<float>(random.uniform(0.01, 0.06));
    puffs.push_back(puff);
  }
  return puffs;
}

struct Sums {
  double area = 0;
  glm::dvec3 mean{0}, variance{0};
};

Sums sumsOf(const std::vector<Puff>& puffs) {
  Sums sums;
  for (const Puff& puff : puffs) {
    const double area = extinctionArea(puff);
    sums.area += area;
    sums.mean += area * glm::dvec3(puff.center);
  }
  sums.mean /= sums.area;
  for (const Puff& puff : puffs) {
    const glm::dmat3 axes(glm::mat3_cast(puff.rotation));
    glm::dvec3 own(0);
    for (int i = 0; i < 3; ++i) own += axes[i] * axes[i] * std::pow(static_cast<double>(puff.sigma[i]), 2);
    const glm::dvec3 away = glm::dvec3(puff.center) - sums.mean;
    sums.variance += extinctionArea(puff) / sums.area * (own + away * away);
  }
  return sums;
}

TEST(Reduce, KeepsExtinctionCentroidAndCovariance) {
  const auto puffs = crowd(300);
  const Sums before = sumsOf(puffs);
  for (const int count : {1, 2, 6, 7, 50, 299}) {
    const auto fewer = reduce(puffs, count);
    EXPECT_LE(fewer.size(), static_cast<std::size_t>(count));
    EXPECT_GE(fewer.size(), static_cast<std::size_t>(count) * 3 / 4);
    const Sums after = sumsOf(fewer);
    EXPECT_NEAR(after.area, before.area, 1e-4 * before.area);
    EXPECT_LT(glm::distance(after.mean, before.mean), 0.05);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(after.variance[axis], before.variance[axis], 1e-3 * before.variance[axis]) << count;
  }
}

TEST(Reduce, AsManyAsThereAreKeepsEveryPlace) {
  const auto puffs = crowd(9);
  for (const int count : {9, 500}) {
    const auto same = reduce(puffs, count);
    ASSERT_EQ(same.size(), puffs.size());
    for (const Puff& puff : puffs)
      EXPECT_TRUE(std::any_of(same.begin(), same.end(), [&](const Puff& other) {
        return glm::distance(other.center, puff.center) < 1e-3f &&
               std::abs(extinctionArea(other) / extinctionArea(puff) - 1) < 1e-4;
      }));
  }
}

TEST(Reduce, NothingStaysNothing) { EXPECT_TRUE(reduce({}, 6).empty()); }

TEST(Reduce, PuffsWithoutExtinctionAreFinite) {
  auto puffs = crowd(20);
  for (Puff& puff : puffs) puff.extinctionPerMeter = 0;
  for (const Puff& puff : reduce(puffs, 3)) {
    EXPECT_EQ(puff.extinctionPerMeter, 0);
    EXPECT_TRUE(std::isfinite(puff.center.x) && std::isfinite(puff.sigma.x));
  }
}

TEST(Puff, OpticalDepthAndAreaAreThoseOfAGaussian) {
  Puff puff;
  puff.sigma = {10, 20, 30};
  puff.extinctionPerMeter = 0.1f;
  EXPECT_NEAR(centralOpticalDepth(0.1f, 10), 0.1 * 10 * 2.5066283, 1e-5);
  EXPECT_NEAR(frontalOpticalDepth(puff), 2.5066283, 1e-5);
  EXPECT_NEAR(extinctionArea(puff), 0.1 * 6000 * 15.7496099, 0.01);
}

TEST(Puff, BoundsFollowTheRotation) {
  Puff puff;
  puff.center = {5, 6, 7};
  puff.sigma = {10, 1, 2};
  puff.rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(0, 1, 0));
  const Bounds bounds = boundsOf(std::vector{puff}, 2);
  EXPECT_LT(glm::distance(bounds.lower, glm::vec3(1, 4, -13)), 1e-3f);
  EXPECT_LT(glm::distance(bounds.upper, glm::vec3(9, 8, 27)), 1e-3f);
}

}  // namespace
}  // namespace cloudgen::shape
