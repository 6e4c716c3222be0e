// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include <cmath>

namespace cloudgen::shape {
namespace {

/// Where a puff of an optical depth, in its deviations, has come down to `covering`.
double reachOfPuff(double opticalDepth, double covering) {
  return std::sqrt(2 * std::log(opticalDepth / covering));
}

/// Where a blended blob has, in its own deviations.
double reachOfBlob(double opticalDepth, double covering) {
  return std::sqrt(2 * std::log((1 - std::exp(-opticalDepth)) / (1 - std::exp(-covering))));
}

TEST(BlendedWidening, ABlobThenCoversWhatItsPuffDoes) {
  for (const double covering : {0.01, 0.07, 0.1})
    for (const double opticalDepth : {0.5, 2.0, 8.0, 50.0}) {
      const double wider = blendedWidening(static_cast<float>(opticalDepth), static_cast<float>(covering));
      EXPECT_GE(wider, 1);
      EXPECT_NEAR(
          wider * reachOfBlob(opticalDepth / (wider * wider), covering) / reachOfPuff(opticalDepth, covering),
          1, 0.02)
          << opticalDepth << ' ' << covering;
    }
}

TEST(BlendedWidening, ThinBlobsStayAsTheyAre) { EXPECT_NEAR(blendedWidening(0.02f, 0.01f), 1, 0.05); }

}  // namespace
/// `count` dense puffs side by side that overlap more, the nearer they stand.
std::vector<Puff> row(int count, float spacingMeters) {
  std::vector<Puff> puffs;
  for (int i = 0; i < count; ++i) {
    Puff puff;
    puff.center = {spacingMeters * static_cast<float>(i), 500, 0};
    puff.sigma = {300, 200, 300};
    puff.extinctionPerMeter = 0.03f;
    puffs.push_back(puff);
  }
  return puffs;
}

TEST(CoveringOf, BlendedPuffsCoverTheGroundOfPuffsHoweverManyOverlap) {
  for (const auto& puffs : {row(1, 0), row(3, 300), row(12, 100), row(30, 40)}) {
    const float covering = coveringOf(puffs);
    const double wanted = coveredSquareMeters(puffs);
    EXPECT_NEAR(blendedSquareMeters(puffs, covering) / wanted, 1, 0.05) << puffs.size();
  }
}

TEST(CoveredSquareMeters, OfOnePuffIsItsEllipse) {
  const auto puffs = row(1, 0);
  const double opticalDepth = frontalOpticalDepth(puffs.front());
  EXPECT_NEAR(coveredSquareMeters(puffs) / (std::numbers::pi * 300 * 300 * 2 * std::log(opticalDepth / 0.1)),
              1, 0.05);
}

}  // namespace cloudgen::shape
