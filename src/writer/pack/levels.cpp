// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/levels.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "shape/blending.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::writer::packed {
namespace {

float errorOf(std::span<const shape::Puff> puffs, std::span<const shape::Puff> merged) {
  double sum = 0, weights = 1e-30;
  for (const shape::Puff& puff : puffs) {
    float nearest2 = 1e30f;
    for (const shape::Puff& into : merged) {
      const glm::vec3 away = puff.center - into.center;
      nearest2 = std::min(nearest2, glm::dot(away, away));
    }
    const double weight = shape::extinctionArea(puff);
    sum += weight * static_cast<double>(nearest2);
    weights += weight;
  }
  return static_cast<float>(std::sqrt(sum / weights / 3));
}

}  // namespace

std::vector<Level> levelsOf(const scene::Archetype& archetype) {
  assert(archetype.response.puffs.size() == archetype.puffs.size());
  std::vector<Level> levels{{archetype.puffs, archetype.response.puffs, 0}};
  const auto add = [&](std::vector<shape::Puff> puffs) {
    if (puffs.empty() || puffs.size() >= levels.back().puffs.size()) return;
    const float error = std::max(errorOf(archetype.puffs, puffs), 1.01f * levels.back().errorMeters);
    levels.push_back(
        {puffs, light::averageResponse(archetype.puffs, archetype.response.puffs, puffs), error});
  };
  const std::size_t quarter = archetype.puffs.size() / 4;
  if (quarter > archetype.farPuffs.size()) add(shape::reduce(archetype.puffs, static_cast<int>(quarter)));
  add(archetype.farPuffs);
  add({archetype.onePuff});
  for (Level& level : levels) {
    const float covering = &level == &levels.front() ? archetype.covering : shape::coveringOf(level.puffs);
    for (shape::Puff& puff : level.puffs) puff = shape::widenedAcross(puff, covering);
  }
  return levels;
}

}  // namespace cloudgen::writer::packed
