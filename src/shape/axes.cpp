// SPDX-License-Identifier: Apache-2.0
#include "shape/axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cloudgen::shape {

PrincipalAxes principalAxes(const glm::dmat3& covariance) {
  constexpr int kSweeps = 12;
  glm::dmat3 matrix = covariance, axes(1);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (std::abs(matrix[p][q]) <= 1e-15 * (std::abs(matrix[p][p]) + std::abs(matrix[q][q]))) continue;
      const double theta = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]),
                   t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1)),
                   c = 1 / std::sqrt(t * t + 1), s = t * c;
      glm::dmat3 turn(1);
      turn[p][p] = c, turn[q][q] = c, turn[q][p] = s, turn[p][q] = -s;
      matrix = glm::transpose(turn) * matrix * turn;
      axes = axes * turn;
    }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return matrix[a][a] > matrix[b][b]; });
  PrincipalAxes out;
  for (int i = 0; i < 3; ++i) {
    out.axes[i] = axes[order[static_cast<std::size_t>(i)]];
    out.variance[i] =
        std::max(0.0, matrix[order[static_cast<std::size_t>(i)]][order[static_cast<std::size_t>(i)]]);
  }
  if (glm::determinant(out.axes) < 0) out.axes[2] = -out.axes[2];
  return out;
}

}  // namespace cloudgen::shape
