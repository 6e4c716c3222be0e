// SPDX-License-Identifier: Apache-2.0
#include "motion/poisson.hpp"

#include <cassert>

namespace cloudgen::motion {

Poisson::Poisson(const glm::ivec3& cells)
    : cells_(cells), x_(cells.x, Ends::Periodic), y_(cells.y, Ends::Walls), z_(cells.z, Ends::Periodic) {}

void Poisson::solve(Lattice& field) const {
  assert(field.places == cells_);
  alongLines(field, 0, [&](float* lines, const glm::ivec3&) { x_.forward(lines); });
  alongLines(field, 1, [&](float* lines, const glm::ivec3&) { y_.forward(lines); });
  alongLines(field, 2, [&](float* lines, const glm::ivec3& first) {
    z_.forward(lines);
    for (int lane = 0; lane < kLanes && first.x + lane < cells_.x; ++lane) {
      const float others = x_.factor(first.x + lane) + y_.factor(first.y);
      for (int z = 0; z < cells_.z; ++z) {
        const float factor = others + z_.factor(z);
        float& amplitude = lines[z * kLanes + lane];
        amplitude = factor > 0 ? -amplitude / factor : 0;
      }
    }
    z_.backward(lines);
  });
  alongLines(field, 1, [&](float* lines, const glm::ivec3&) { y_.backward(lines); });
  alongLines(field, 0, [&](float* lines, const glm::ivec3&) { x_.backward(lines); });
}

}  // namespace cloudgen::motion
