// SPDX-License-Identifier: Apache-2.0
#include "light/color.hpp"

#include <cmath>

namespace cloudgen::light {
namespace {

TEST(Color, KnownValuesOfTheStandard) {
  const glm::vec3 encoded = srgbFromLinear({0.5f, 0.002f, 0.214041f});
  EXPECT_NEAR(encoded.x, 0.735357, 1e-5);
  EXPECT_NEAR(encoded.y, 0.02584, 1e-5);
  EXPECT_NEAR(encoded.z, 0.5, 1e-5);
  EXPECT_EQ(srgbFromLinear({0, 0, 0}), glm::vec3(0));
  EXPECT_NEAR(srgbFromLinear({1, 1, 1}).x, 1, 1e-6);
}

TEST(Color, ThereAndBackIsTheSame) {
  for (int i = 0; i <= 255; ++i) {
    const float v = static_cast<float>(i) / 255;
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(glm::vec3(v))).y, v, 1e-5);
    EXPECT_NEAR(linearFromSrgb(srgbFromLinear(glm::vec3(v))).y, v, 1e-5);
  }
}

TEST(Color, IsTheCurveOfTheStandardEverywhere) {
  for (int i = 0; i <= 100'000; ++i) {
    const double v = i / 1e5;
    const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    ASSERT_NEAR(srgbFromLinear(glm::vec3(static_cast<float>(v))).x, encoded, 1e-6) << v;
  }
}

TEST(Color, OutOfRangeIsClamped) {
  EXPECT_EQ(srgbFromLinear({-1, 2, 1}).x, 0);
  EXPECT_NEAR(srgbFromLinear({-1, 2, 1}).y, 1, 1e-6);
  EXPECT_NEAR(linearFromSrgb({-1, 2, 1}).y, 1, 1e-6);
}

}  // namespace
}  // namespace cloudgen::light
