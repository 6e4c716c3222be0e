// SPDX-License-Identifier: Apache-2.0
#include "light/harmonics.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace cloudgen::light {

Harmonics harmonicsOf(const glm::vec3& d) {
  const float x = d.x, y = d.z, z = d.y;  // the polar axis is up
  const float xx = x * x, yy = y * y, zz = z * z;
  return {0.28209479f,
          0.48860251f * y,
          0.48860251f * z,
          0.48860251f * x,
          1.09254843f * x * y,
          1.09254843f * y * z,
          0.31539157f * (3 * zz - 1),
          1.09254843f * x * z,
          0.54627422f * (xx - yy),
          0.59004359f * y * (3 * xx - yy),
          2.89061144f * x * y * z,
          0.45704580f * y * (5 * zz - 1),
          0.37317633f * z * (5 * zz - 3),
          0.45704580f * x * (5 * zz - 1),
          1.44530572f * z * (xx - yy),
          0.59004359f * x * (xx - 3 * yy)};
}

float dot(const Harmonics& a, const Harmonics& b) {
  float sum = 0;
  for (std::size_t i = 0; i < kHarmonics; ++i) sum += a[i] * b[i];
  return sum;
}

HarmonicFit::HarmonicFit(std::span<const glm::vec3> directions) {
  assert(directions.size() >= kHarmonics);
  for (const glm::vec3& direction : directions) columns_.push_back(harmonicsOf(direction));
  // A sun far under the horizon lights no cloud: less weight for what it would do.
  std::vector<double> weights;
  for (const glm::vec3& direction : directions) weights.push_back(direction.y < -0.25f ? 0.05 : 1.0);
  // Normal equations by Cholesky.
  constexpr std::size_t n = kHarmonics;
  std::array<std::array<double, n>, n> lower{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t d = 0; d < columns_.size(); ++d)
        sum += weights[d] * static_cast<double>(columns_[d][i]) * columns_[d][j];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
      lower[i][j] = i == j ? std::sqrt(sum) : sum / lower[j][j];
    }
  for (std::size_t d = 0; d < columns_.size(); ++d) {
    Harmonics& column = columns_[d];
    std::array<double, n> solved{};
    for (std::size_t i = 0; i < n; ++i) {
      double sum = weights[d] * column[i];
      for (std::size_t k = 0; k < i; ++k) sum -= lower[i][k] * solved[k];
      solved[i] = sum / lower[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
      double sum = solved[i];
      for (std::size_t k = i + 1; k < n; ++k) sum -= lower[k][i] * solved[k];
      solved[i] = sum / lower[i][i];
    }
    for (std::size_t i = 0; i < n; ++i) column[i] = static_cast<float>(solved[i]);
  }
}

Harmonics HarmonicFit::operator()(std::span<const float> samples) const {
  assert(samples.size() == columns_.size());
  Harmonics sum{};
  for (std::size_t j = 0; j < samples.size(); ++j)
    for (std::size_t i = 0; i < kHarmonics; ++i) sum[i] += columns_[j][i] * samples[j];
  return sum;
}

std::vector<glm::vec3> opposedDirections(int rings) {
  std::vector<glm::vec3> directions;
  const int half = 2 * rings * (rings + 1);
  for (int ring = 0, before = 0; ring < rings; ++ring) {
    const int count = 4 * (ring + 1);
    const double y = 1.0 - (before + 0.5 * count) / half, r = std::sqrt(1 - y * y);
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / count;
      directions.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
    }
    before += count;
  }
  for (int i = 0; i < half; ++i) directions.push_back(-directions[static_cast<std::size_t>(i)]);
  return directions;
}

}  // namespace cloudgen::light
