// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "shape/forms.hpp"

namespace cloudgen::shape {

RawShape shapeHeap(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const int budgetedSections = std::max(3, request.puffs / std::max(1, recipe.billboards));
  const int sections = std::min(recipe.sections, budgetedSections);

  // One main tower off the middle and lesser ones about it, as a real heap has.
  const double mainX = places.uniform(-0.12, 0.12) * width, mainZ = places.uniform(-0.12, 0.12) * width;
  std::vector<Lobe> lobes;
  const auto points = place(recipe.sectionPlacement, sections, places);
  for (int i = 0; i < sections; ++i) {
    const glm::dvec3 p = points[i];  // within a half ball of radius 1
    const double reach = 0.34 * width;
    const double x = p.x * reach + mainX * (1 - std::abs(p.x)), z = p.z * reach + mainZ * (1 - std::abs(p.z));
    const double fromMain = std::hypot(x - mainX, z - mainZ) / (0.5 * width);
    // A rising profile: the tower over the middle, shoulders about it, fractus at the rim.
    const double profile = std::clamp(1.0 - 0.95 * std::pow(fromMain, 1.3), 0.12, 1.0) * places.uniform(0.7, 1.0);
    const double top = depth * (i == 0 ? 0.97 : profile);
    const double radius = std::min(recipe.sectionRadius * width * places.uniform(0.72, 1.2) * (1.0 - 0.35 * fromMain), 0.52 * top);
    int level = 0;
    for (double y = 0.42 * radius; y <= std::max(top - radius, 0.42 * radius) + 1e-9; y += 0.72 * radius) {
      const double share = y / depth;
      const double shrink = radius * (1.0 - 0.38 * share) * places.uniform(0.85, 1.1);
      const double wobble = 0.2 * radius;
      lobes.push_back({{x + request.tilt * y + wobble * places.uniform(-1, 1), std::min(y, depth - shrink * 0.95),
                        z + wobble * places.uniform(-1, 1)},
                       shrink, static_cast<std::uint16_t>(i), level});
    }
  }
  if (request.puffs >= 12 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 9, 0.46, places);
  if (request.puffs >= 40 * static_cast<int>(lobes.size())) growLobes(lobes, 2, 5, 0.45, places);
  for (Lobe& lobe : lobes) lobe.center.y = std::min(lobe.center.y, depth - 0.8 * lobe.radius);
  RawShape shape;
  fillLobes(shape.puffs, lobes, recipe, request.puffs, 0, fills);
  // Liquid water grows with height above the base (adiabatic ascent).
  for (Puff& puff : shape.puffs)
    puff.extinctionPerMeter *= 0.55f + 0.45f * static_cast<float>(std::min(1.0, puff.center.y / depth));
  return shape;
}

}  // namespace cloudgen::shape
