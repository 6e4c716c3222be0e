// SPDX-License-Identifier: Apache-2.0
#include "field/curvilinear.hpp"

#include <cmath>

#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Side of a cell that has no neighbour to tell it, radians (11 km).
constexpr double kLoneSide = 0.1 * kDegree;

glm::dvec3 centerVector(const Grid& grid, int column, int row) {
  return vectorOf(grid.centers[grid.index(column, row)]);
}

/// A centre, also one cell outside of the grid.
glm::dvec3 node(const Grid& grid, int column, int row);

/// From the only column one step sideways: square to the column, as long as a step along it.
glm::dvec3 sideways(const Grid& grid, int row) {
  const glm::dvec3 here = node(grid, 0, row);
  if (grid.rows == 1) return kLoneSide * glm::normalize(glm::cross({0, 0, 1}, here));
  const int inside = std::min(std::max(row, 0), grid.rows - 2);
  return glm::cross(centerVector(grid, 0, inside + 1) - centerVector(grid, 0, inside), here);
}

glm::dvec3 node(const Grid& grid, int column, int row) {
  if (grid.wrapsLongitude) column = (column % grid.columns + grid.columns) % grid.columns;
  if (column < 0 || column >= grid.columns) {
    const int edge = column < 0 ? 0 : grid.columns - 1, inner = column < 0 ? 1 : grid.columns - 2;
    if (grid.columns == 1) return node(grid, 0, row) + static_cast<double>(column) * sideways(grid, row);
    return 2.0 * node(grid, edge, row) - node(grid, inner, row);
  }
  if (row < 0 || row >= grid.rows) {
    const int edge = row < 0 ? 0 : grid.rows - 1, inner = row < 0 ? 1 : grid.rows - 2;
    const glm::dvec3 last = centerVector(grid, column, edge);
    if (grid.rows > 1) return 2.0 * last - centerVector(grid, column, inner);
    // The only row: square to it, as long as a step along it.
    const glm::dvec3 along = grid.columns == 1 ? kLoneSide * glm::normalize(glm::cross({0, 0, 1}, last))
                             : column == 0     ? centerVector(grid, 1, 0) - last
                                               : last - centerVector(grid, column - 1, 0);
    return last + static_cast<double>(row) * glm::cross(last, along);
  }
  return centerVector(grid, column, row);
}

}  // namespace

glm::dvec3 curvilinearVector(const Grid& grid, double columnAndU, double rowAndV) {
  const double x = columnAndU - 0.5, y = rowAndV - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, down = y - row;
  glm::dvec3 sum = (1 - right) * (1 - down) * node(grid, column, row);
  // Only what counts is looked at: a missing neighbour does not spoil a centre.
  if (right > 0) sum += right * (1 - down) * node(grid, column + 1, row);
  if (down > 0) sum += (1 - right) * down * node(grid, column, row + 1);
  if (right > 0 && down > 0) sum += right * down * node(grid, column + 1, row + 1);
  return glm::normalize(sum);
}

std::array<glm::dvec3, 4> curvilinearCorners(const Grid& grid, std::uint32_t cell) {
  const int column = grid.column(cell), row = grid.row(cell);
  return {curvilinearVector(grid, column, row), curvilinearVector(grid, column + 1, row),
          curvilinearVector(grid, column + 1, row + 1), curvilinearVector(grid, column, row + 1)};
}

bool quadHolds(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& place) {
  const glm::dvec3 middle = corners[0] + corners[1] + corners[2] + corners[3];
  if (!(glm::dot(middle, place) > 0)) return false;
  bool left = false, right = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 edge = corners[(i + 1) % 4] - corners[i];
    const double side = glm::dot(glm::cross(edge, place - corners[i]), place);
    const double onTheEdge = 1e-9 * glm::dot(edge, edge);
    left |= side > onTheEdge;
    right |= side < -onTheEdge;
  }
  return !(left && right);
}

}  // namespace cloudgen::field
