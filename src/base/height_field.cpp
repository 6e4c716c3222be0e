// SPDX-License-Identifier: Apache-2.0
#include "base/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace cloudgen::base {

double HeightField::heightAt(double x, double z) const {
  const double u = std::clamp((x - origin.x) / step.x, 0.0, columns - 1.0);
  const double v = std::clamp((z - origin.y) / step.y, 0.0, rows - 1.0);
  const int column = std::min(static_cast<int>(u), columns - 2),
            row = std::min(static_cast<int>(v), rows - 2);
  const double a = u - column, b = v - row;
  return (1 - b) * ((1 - a) * at(column, row) + a * at(column + 1, row)) +
         b * ((1 - a) * at(column, row + 1) + a * at(column + 1, row + 1));
}

bool HeightField::covers(double x, double z) const {
  return x >= origin.x && z >= origin.y && x <= origin.x + (columns - 1) * step.x &&
         z <= origin.y + (rows - 1) * step.y;
}

float HeightField::highest() const { return *std::max_element(heights.begin(), heights.end()); }

glm::vec3 HeightField::normal(int column, int row, double slopeFactor) const {
  const int west = std::max(column - 1, 0), east = std::min(column + 1, columns - 1);
  const int north = std::max(row - 1, 0), south = std::min(row + 1, rows - 1);
  const double slopeX = (at(east, row) - at(west, row)) / ((east - west) * step.x);
  const double slopeZ = (at(column, south) - at(column, north)) / ((south - north) * step.y);
  return glm::vec3(glm::normalize(glm::dvec3(-slopeFactor * slopeX, 1, -slopeFactor * slopeZ)));
}

std::vector<std::uint32_t> trianglesOf(const HeightField& field) {
  std::vector<std::uint32_t> corners;
  for (int row = 0; row + 1 < field.rows; ++row)
    for (int column = 0; column + 1 < field.columns; ++column) {
      const auto first = static_cast<std::uint32_t>(row * field.columns + column);
      const std::uint32_t below = first + static_cast<std::uint32_t>(field.columns);
      corners.insert(corners.end(), {first, below, below + 1, first, below + 1, first + 1});
    }
  return corners;
}

}  // namespace cloudgen::base
