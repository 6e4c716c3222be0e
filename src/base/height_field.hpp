// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::base {

/// Heights in metres on a regular lattice of the scene frame: point (column, row) lies at x = origin.x +
/// column * step.x and z = origin.y + row * step.y (southwards). Row by row; empty where there is no relief.
struct HeightField {
  int columns = 0, rows = 0;
  glm::dvec2 origin{0}, step{0};
  std::vector<float> heights;

  bool empty() const { return heights.empty(); }
  float at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
  glm::dvec3 point(int column, int row) const {
    return {origin.x + column * step.x, at(column, row), origin.y + row * step.y};
  }
  /// Bilinear; beyond the lattice as at its border. Not to be asked of an empty field.
  double heightAt(double x, double z) const;
  /// True if the place lies within the lattice.
  bool covers(double x, double z) const;
  float highest() const;
  /// Unit normal at a point of the lattice with the slopes multiplied by a factor.
  glm::vec3 normal(int column, int row, double slopeFactor = 1) const;
};

/// The triangles of a lattice, as corners: counter-clockwise seen from above.
std::vector<std::uint32_t> trianglesOf(const HeightField& field);

}  // namespace cloudgen::base
