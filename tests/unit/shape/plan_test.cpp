// SPDX-License-Identifier: Apache-2.0
#include "shape/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cloudgen::shape {
namespace {

constexpr int kPixels = 40;

/// The Gaussian in the middle of a pixel, as it is defined.
double gaussianAt(const PlanGaussian& plan, const PlanRaster& raster, const glm::dvec2& lower, int column, int row) {
  const double dx = lower.x + (column + 0.5) * raster.pixel().x - plan.x,
               dz = lower.y + (row + 0.5) * raster.pixel().y - plan.z;
  return std::exp(-0.5 * (plan.zz * dx * dx - 2 * plan.xz * dx * dz + plan.xx * dz * dz) / plan.determinant());
}

/// Steps from pixel to pixel add up to the exponential itself: of round ones, slants, needles, what is narrower than a
/// pixel and what stands at the border or outside.
TEST(PlanRaster, PaintsTheGaussian) {
  const glm::dvec2 lower(-100, -60), upper(100, 60);
  for (const PlanGaussian& plan : {PlanGaussian{0, 0, 400, 0, 400}, PlanGaussian{13, -7, 900, 350, 200},
                                   PlanGaussian{-20, 5, 900, -890, 890}, PlanGaussian{31, 8, 0.5, 0.1, 0.5},
                                   PlanGaussian{99, -59, 300, 100, 200}, PlanGaussian{120, 10, 400, -50, 100}}) {
    PlanRaster raster(lower, upper, kPixels);
    raster.add(plan, [](double gaussian) { return gaussian; });
    for (int row = 0; row < kPixels; ++row)
      for (int column = 0; column < kPixels; ++column) {
        const double expected = gaussianAt(plan, raster, lower, column, row),
                     painted = raster.values()[static_cast<std::size_t>(row * kPixels + column)];
        const bool isFar = expected < 0.0022;  // 3.5 deviations and more may be left out
        EXPECT_NEAR(painted, expected, isFar ? expected : 1e-6 * expected) << plan.xx << " " << column << " " << row;
      }
  }
}

TEST(PlanRaster, CountsWhatCameToHaveEnough) {
  PlanRaster raster({-10, -10}, {10, 10}, 20);
  const PlanGaussian plan{0, 0, 9, 0, 9};
  const auto half = [](double gaussian) { return 0.6 * gaussian; };
  EXPECT_GT(raster.addUpTo(0.5, plan, half), 0u);
  const std::size_t more = raster.addUpTo(0.5, plan, half);
  std::size_t full = 0;
  for (const float value : raster.values()) full += value > 0.5f;
  EXPECT_GT(more, 0u);
  EXPECT_LT(more, full);
}

}  // namespace
}  // namespace cloudgen::shape
