// SPDX-License-Identifier: Apache-2.0
#include "shape/blending.hpp"

#include <gtest/gtest.h>

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
}  // namespace cloudgen::shape
