// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace cloudgen::light {

/// Real spherical harmonics up to degree 3, without the Condon-Shortley sign, y up; orthonormal over the
/// sphere (Sloan 2008, "Stupid spherical harmonics tricks").
inline constexpr int kHarmonics = 16;
using Harmonics = std::array<float, kHarmonics>;

Harmonics harmonicsOf(const glm::vec3& direction);

/// Sum of coefficients times harmonics.
float dot(const Harmonics& a, const Harmonics& b);

/// Turns samples of a function at fixed directions into the coefficients that fit them best (least squares).
class HarmonicFit {
 public:
  explicit HarmonicFit(std::span<const glm::vec3> directions);
  /// One sample a direction, in the order of the constructor.
  Harmonics operator()(std::span<const float> samples) const;

 private:
  std::vector<Harmonics> columns_;  ///< what one sample adds to each coefficient
};

/// Directions over the upper half of the sphere on rings of 4, 8, 12, ... of equal share each, symmetric
/// about the axes, then their opposites in the same order: 4 rings (rings + 1) together.
std::vector<glm::vec3> opposedDirections(int rings);

}  // namespace cloudgen::light
