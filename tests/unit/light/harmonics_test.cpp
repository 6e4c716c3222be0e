// SPDX-License-Identifier: Apache-2.0
#include "light/harmonics.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace cloudgen::light {
namespace {

TEST(Harmonics, AreOrthonormal) {
  const auto directions = opposedDirections(45);
  const double each = 4 * std::numbers::pi / static_cast<double>(directions.size());
  for (std::size_t i = 0; i < kHarmonics; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (const glm::vec3& direction : directions) {
        const Harmonics y = harmonicsOf(direction);
        sum += each * y[i] * y[j];
      }
      EXPECT_NEAR(sum, i == j ? 1 : 0, 5e-3) << i << ' ' << j;
    }
}

TEST(Harmonics, AFitGivesBackAPolynomialOfDegreeThree) {
  const auto directions = opposedDirections(3);
  const auto function = [](const glm::vec3& d) {
    const float half = 0.5f + 0.5f * glm::dot(d, glm::vec3(0.6f, 0.64f, 0.48f));
    return half * half * half + 0.2f * d.x * d.z;
  };
  std::vector<float> samples;
  for (const glm::vec3& direction : directions) samples.push_back(function(direction));
  const Harmonics fitted = HarmonicFit(directions)(samples);
  for (const glm::vec3& d : opposedDirections(5)) EXPECT_NEAR(dot(fitted, harmonicsOf(d)), function(d), 1e-4);
}

TEST(Harmonics, DirectionsAreEvenAndOpposed) {
  const auto directions = opposedDirections(3);
  ASSERT_EQ(directions.size(), 48u);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(directions[i], -directions[i + 24]);
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_NEAR(glm::length(directions[i]), 1, 1e-6);
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(glm::dot(directions[i], directions[j]), 0.95f);
  }
}

}  // namespace
}  // namespace cloudgen::light
