// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {

RawShape shapeCells(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const int affordable = std::max(3, static_cast<int>(std::sqrt(request.puffs / 4.0)));
  // A smaller piece of the layer has fewer elements, not narrower ones.
  constexpr double kUsualAspect = 22;
  const int fitting = std::max(
      2, static_cast<int>(std::lround(recipe.sections * std::min(1.0, width / (kUsualAspect * depth)))));
  const int across = std::min(fitting, affordable);
  const double pitch = width / across;
  const std::uint64_t noiseSeed = request.seed * 31 + request.variant;

  struct Cell {
    glm::dvec3 center;
    double radius, height, weight;
  };
  std::vector<Cell> cells;
  double totalArea = 0;
  for (int row = -1; row <= across; ++row)
    for (int column = -1; column <= across; ++column) {
      const double stagger = (row & 1) ? 0.5 : 0.0;
      glm::dvec3 p((column + 0.5 + stagger) * pitch - 0.5 * width, 0, (row + 0.5) * pitch - 0.5 * width);
      p.x += 0.32 * pitch * places.gaussian();
      p.z += 0.24 * pitch * places.gaussian();
      // Rolls: the rows meander, so that they do not look ruled.
      p.z += 0.9 * pitch * base::fractalNoise({p.x / (5.0 * pitch), 0.3, p.z / (7.0 * pitch)}, 2, noiseSeed);
      const double q = std::hypot(p.x, p.z) / (0.5 * width);
      const double ragged =
          base::fractalNoise({p.x / (4.5 * pitch), 1.7, p.z / (4.5 * pitch)}, 3, noiseSeed + 5);
      const double fade = 1.0 - base::smoothStep(0.72, 1.08, q + 0.55 * ragged);
      const double vigour = places.uniform(0.65, 1.2) * (0.75 + 0.9 * ragged + 0.25);
      if (fade < 0.04 || vigour * fade < 0.3) continue;
      const double radius =
          recipe.sectionRadius * pitch * std::clamp(vigour, 0.55, 1.35) * (0.6 + 0.4 * fade);
      cells.push_back({p, radius, depth * std::clamp(0.45 + 0.55 * vigour, 0.3, 1.0), fade});
      totalArea += radius * radius;
    }
  RawShape shape;
  double owed = 0;
  for (size_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    owed += request.puffs * cell.radius * cell.radius / totalArea;
    const int share = std::max(1, static_cast<int>(owed));
    owed -= share;
    const double spacing = cell.radius * std::sqrt(3.1416 / share);
    const double sigma = std::min(recipe.billboardSize * cell.radius * 1.3, 0.75 * spacing);
    const double stretch = 1.0 + 0.8 * recipe.fibre;
    for (int i = 0; i < share; ++i) {
      // A lens with a lumpy top: billboards by the recipe's system, drawn in to a flattened dome.
      const glm::dvec3 p = place(recipe.billboardPlacement, 1, fills).front();
      const double r = std::min(1.0, std::hypot(p.x, p.z));
      const double dome = std::sqrt(std::max(0.0, 1.0 - r * r));
      glm::dvec3 position(cell.center.x + p.x * cell.radius * stretch, 0,
                          cell.center.z + p.z * cell.radius / stretch);
      const double lump = base::billowNoise(position * (2.2 / cell.radius), 2, noiseSeed + 9) - 0.72;
      position.y = cell.height * (0.16 + 0.66 * dome * std::sqrt(fills.uniform()) + 0.5 * lump * dome) +
                   0.06 * cell.height * fills.gaussian();
      position.y = std::clamp(position.y, 0.06 * depth, 0.97 * depth);
      Puff puff;
      const double size = sigma * fills.uniform(0.75, 1.25);
      puff.center = position;
      puff.sigma =
          glm::vec3(size * stretch, std::min(size * recipe.flattening, 0.3 * cell.height), size / stretch);
      puff.extinctionPerMeter = static_cast<float>(
          cell.weight * (0.25 + 0.9 * dome) * std::clamp(1.0 + recipe.raggedness * 2.0 * lump, 0.2, 1.6));
      puff.section = static_cast<std::uint16_t>(c);
      shape.puffs.push_back(puff);
    }
  }
  return shape;
}

}  // namespace cloudgen::shape
