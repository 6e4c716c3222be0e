// SPDX-License-Identifier: Apache-2.0
// Reference for multiple scattering: photons, one after another, no approximation but the grid.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "light/extinction_grid.hpp"

namespace cloudgen::test {

/// Turns a unit direction by an angle with cosine `cosine`, about itself by `turn`.
inline glm::vec3 deflected(const glm::vec3& direction, float cosine, float turn) {
  const glm::vec3 other = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(other, direction)), v = glm::cross(direction, u);
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  return glm::normalize(cosine * direction + sine * (std::cos(turn) * u + std::sin(turn) * v));
}

/// Draws the cosine of a Henyey-Greenstein deflection (Witt 1977).
inline float henyeyGreensteinCosine(double uniform, double g) {
  if (std::abs(g) < 1e-3) return static_cast<float>(2 * uniform - 1);
  const double s = (1 - g * g) / (1 - g + 2 * g * uniform);
  return static_cast<float>((1 + g * g - s * s) / (2 * g));
}

/// A photon that was scattered at least once, where it leaves: its direction, and the orders it went through.
struct Escape {
  glm::vec3 direction;
  int scatterings;
};

struct Traced {
  std::vector<Escape> escaped;
  double areaPerPhoton = 0;  ///< of the beam, m2
};

/// Parallel light from a unit direction `towardsSun` onto the medium of a grid that scatters without loss.
/// Free paths by tracking with a majorant (Woodcock 1965); photon i is a pure function of (seed, i).
inline Traced tracePhotons(const light::ExtinctionGrid& grid, const glm::vec3& towardsSun, double g,
                           int photons, std::uint64_t seed) {
  const glm::vec3 size = glm::vec3(grid.size()) * grid.cellMeters(), center = grid.lower() + 0.5f * size;
  const float radius = 0.5f * glm::length(size);
  float most = 0;
  for (const float value : grid.cells()) most = std::max(most, value);
  Traced traced;
  traced.areaPerPhoton = std::numbers::pi * radius * radius / photons;
  for (int i = 0; i < photons; ++i) {
    base::RandomStream random(seed, static_cast<std::uint64_t>(i), base::Purpose::Test);
    const auto uniform = [&] { return static_cast<float>(random.uniform()); };
    const float r = radius * std::sqrt(uniform());
    const glm::vec3 side = deflected(towardsSun, 0, 2 * std::numbers::pi_v<float> * uniform());
    glm::vec3 point = center + radius * towardsSun + r * side, direction = -towardsSun;
    int scatterings = 0;
    while (true) {
      point -= direction * (std::log(1 - uniform()) / most);
      const glm::vec3 inside = point - center;
      if (glm::dot(inside, direction) > 0 && glm::dot(inside, inside) > radius * radius) break;
      if (glm::dot(inside, inside) > 4 * radius * radius) break;
      if (uniform() * most > grid.extinction(point)) continue;
      ++scatterings;
      direction = deflected(direction, henyeyGreensteinCosine(random.uniform(), g),
                            2 * std::numbers::pi_v<float> * uniform());
    }
    if (scatterings > 0) traced.escaped.push_back({direction, scatterings});
  }
  return traced;
}

}  // namespace cloudgen::test
