// SPDX-License-Identifier: Apache-2.0
#include "motion/guide_points.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/thread.hpp"

namespace cloudgen::motion {
namespace {

constexpr int kCellsAcross = 32;     ///< along the longest side of the box
constexpr float kFarthest = 0.6f;  ///< that a puff goes, in standard deviations of it

/// A box of cells twice as wide as the cloud and half as high again.
struct Around {
  glm::vec3 lower;
  glm::ivec3 cells;
  float cellMeters;
};

Around around(std::span<const shape::Puff> puffs) {
  const shape::Bounds box = shape::boundsOf(puffs);
  const glm::vec3 size = glm::max(box.upper - box.lower, glm::vec3(1)), room = size * glm::vec3(1, 0.5f, 1);
  const glm::vec3 whole = size + room;
  const float cell = std::max({whole.x, whole.y, whole.z}) / kCellsAcross;
  const glm::ivec3 cells = glm::max(glm::ivec3(glm::ceil(whole / cell)), glm::ivec3(4));
  return {box.lower - 0.5f * (glm::vec3(cells) * cell - size), cells, cell};
}

/// The optical thickness of the cloud in each cell, 1 where it is thickest.
Lattice shareOf(std::span<const shape::Puff> puffs, const Around& box) {
  Lattice share(box.cells);
  base::parallelFor(static_cast<std::size_t>(box.cells.z), [&](std::size_t plane) {
    const int z = static_cast<int>(plane);
    for (int y = 0; y < box.cells.y; ++y)
      for (int x = 0; x < box.cells.x; ++x) {
        const glm::vec3 place = box.lower + (glm::vec3(x, y, z) + 0.5f) * box.cellMeters;
        float sum = 0;
        for (const shape::Puff& puff : puffs) {
          const glm::vec3 from = glm::conjugate(puff.rotation) * (place - puff.center) /
                                 glm::max(puff.sigma, glm::vec3(0.5f * box.cellMeters));
          sum += puff.extinctionPerMeter * std::exp(-0.5f * glm::dot(from, from));
        }
        share.at(x, y, z) = sum;
      }
  });
  const float most = *std::max_element(share.values.begin(), share.values.end());
  if (most > 0)
    for (float& value : share.values) value /= most;
  return share;
}

float eased(float share) { return share * share * (3 - 2 * share); }

}  // namespace

void carryPoints(const Fluid& fluid, float seconds, std::span<glm::vec3> places) {
  base::parallelFor(places.size(), [&](std::size_t i) {
    const glm::vec3 half = places[i] + 0.5f * seconds * fluid.velocityAt(places[i]);
    places[i] += seconds * fluid.velocityAt(half);
  });
}

IdleLoop idleLoop(std::span<const shape::Puff> puffs, const IdleAir& air, float seconds, int steps) {
  IdleLoop loop{seconds, {}};
  if (puffs.empty()) return loop;
  const Around box = around(puffs);
  Fluid fluid(box.cells, box.cellMeters);
  const float step = seconds / static_cast<float>(steps);
  Forcing forcing;
  forcing.stability = air.stability;
  forcing.viscosity = 0.002f * box.cellMeters * box.cellMeters;
  forcing.wind.resize(static_cast<std::size_t>(box.cells.y));
  for (int y = 0; y < box.cells.y; ++y) {
    const float height = (static_cast<float>(y) + 0.5f) / static_cast<float>(box.cells.y) - 0.5f;
    forcing.wind[static_cast<std::size_t>(y)] = height * air.shear;
  }
  // So much heat as brings the air to its updraft in half a round.
  forcing.heating = shareOf(puffs, box).values;
  for (float& heat : forcing.heating) heat *= 8 * air.updraft / (seconds * seconds);

  std::vector<glm::vec3> places;
  for (const shape::Puff& puff : puffs) places.push_back(puff.center - box.lower);
  const std::vector<glm::vec3> home = places;
  std::vector<std::vector<glm::vec3>> ways;
  for (int i = 0; i <= 2 * steps; ++i) {
    std::vector<glm::vec3> way(places.size());
    for (std::size_t p = 0; p < places.size(); ++p) way[p] = places[p] - home[p];
    ways.push_back(std::move(way));
    fluid.step(step, forcing);
    carryPoints(fluid, step, places);
  }
  const auto round = static_cast<std::size_t>(steps);
  for (std::size_t i = 0; i < round; ++i) {
    const float share = eased(static_cast<float>(i) / static_cast<float>(steps));
    std::vector<glm::vec3> shifts(places.size());
    for (std::size_t p = 0; p < places.size(); ++p) {
      const glm::vec3 shift = (1 - share) * ways[i + round][p] + share * ways[i][p] - ways[round][p];
      // Softly bounded, or the cloud would come apart.
      const float bound = kFarthest * std::max({puffs[p].sigma.x, puffs[p].sigma.y, puffs[p].sigma.z});
      shifts[p] = shift / (1 + glm::length(shift) / bound);
    }
    loop.shifts.push_back(std::move(shifts));
  }
  return loop;
}

}  // namespace cloudgen::motion
