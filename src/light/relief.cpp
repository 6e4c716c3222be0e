// SPDX-License-Identifier: Apache-2.0
#include "light/relief.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "light/optics.hpp"

namespace cloudgen::light {

glm::vec3 reliefColor(const base::HeightField& field, int column, int row, const Sun& sun, const Sky& sky) {
  const double slopeFactor = std::clamp(std::max(field.step.x, field.step.y) / 2500.0, 1.0, 12.0);
  const glm::vec3 normal = field.normal(column, row, slopeFactor);
  // Level ground has the flat ground's colour under every sun, and a sun that is down leaves no relief.
  const float low = glm::smoothstep(-0.02f, 0.05f, sun.direction.y) / std::max(sun.direction.y, 0.15f);
  const float lit = std::clamp(1 + low * (glm::dot(normal, sun.direction) - sun.direction.y), 0.0f, 1.8f);
  const float high = glm::smoothstep(200.0f, 4500.0f, field.at(column, row));
  const glm::vec3 tint = glm::mix(glm::vec3(1), glm::vec3(2.3f, 1.6f, 1.75f), high);
  return glm::min(sky.ground * tint * glm::mix(0.45f, 1.0f, lit), glm::vec3(1));
}

glm::vec3 groundDimming(float opticalDepth, const Sun& sun, const Sky& sky) {
  // Light that was deflected by the forward peak alone, a share g^2, still comes as from the sun (similarity,
  // Joseph et al. 1976); an eighth of the rest finds its way through and around a cloud to the ground below.
  constexpr float kStraight = kWaterAsymmetry * kWaterAsymmetry, kAround = 0.12f;
  const float direct = kAround + (1 - kAround) * std::exp(-(1 - kStraight) * opticalDepth);
  const glm::vec3 fromSun = std::max(sun.direction.y, 0.0f) * sun.color, fromSky = 0.62f * sky.ambient;
  return (direct * fromSun + fromSky) / glm::max(fromSun + fromSky, glm::vec3(1e-6f));
}

glm::vec3 shadedReliefColor(const base::HeightField& field, int column, int row, const Sun& sun,
                            const Sky& sky, const ShadowPlane& shadows) {
  constexpr int kSamples = 4;
  const glm::dvec3 point = field.point(column, row);
  glm::vec3 shade(0);
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const glm::dvec2 offset = field.step * (glm::dvec2(i + 0.5, j + 0.5) / double{kSamples} - 0.5);
      shade += groundDimming(shadows.opticalDepthTo(glm::vec3(point + glm::dvec3(offset.x, 0, offset.y))), sun,
                             sky);
    }
  return reliefColor(field, column, row, sun, sky) * shade / static_cast<float>(kSamples * kSamples);
}

glm::vec3 reliefColorAt(const base::HeightField& field, double x, double z, const Sun& sun, const Sky& sky) {
  const double u = std::clamp((x - field.origin.x) / field.step.x, 0.0, field.columns - 1.0);
  const double v = std::clamp((z - field.origin.y) / field.step.y, 0.0, field.rows - 1.0);
  const int column = std::min(static_cast<int>(u), field.columns - 2);
  const int row = std::min(static_cast<int>(v), field.rows - 2);
  const auto corner = [&](int right, int down) {
    return reliefColor(field, column + right, row + down, sun, sky);
  };
  const float a = static_cast<float>(u - column), b = static_cast<float>(v - row);
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), a), glm::mix(corner(0, 1), corner(1, 1), a), b);
}

}  // namespace cloudgen::light
