// SPDX-License-Identifier: Apache-2.0
#include "light/relief.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::light {

glm::vec3 reliefColor(const base::HeightField& field, int column, int row, const Sun& sun, const Sky& sky) {
  const double slopeFactor = std::clamp(std::max(field.step.x, field.step.y) / 2500.0, 1.0, 12.0);
  const glm::vec3 normal = field.normal(column, row, slopeFactor);
  const float flat = std::max(sun.direction.y, 0.15f);
  const float lit = std::clamp(glm::dot(normal, sun.direction) / flat, 0.0f, 1.8f);
  const float high = glm::smoothstep(200.0f, 4500.0f, field.at(column, row));
  const glm::vec3 tint = glm::mix(glm::vec3(1), glm::vec3(2.3f, 1.6f, 1.75f), high);
  return glm::min(sky.ground * tint * glm::mix(0.45f, 1.0f, lit), glm::vec3(1));
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
