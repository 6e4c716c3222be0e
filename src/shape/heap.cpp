// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "shape/forms.hpp"

namespace cloudgen::shape {

namespace {

constexpr double kFlatAspect = 0.3;

/// A cloud much wider than tall stands for a field of heaps: domes side by side that cover its footprint.
RawShape shapeHeapField(const Recipe& recipe, const ShapeRequest& request) {
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const double width = request.widthMeters, depth = request.depthMeters;
  const double natural = std::pow(width / (1.6 * depth), 2.0);
  const int domes = std::clamp(static_cast<int>(std::min(natural, request.puffs / 5.0)), 3, 400);
  const Placement disc{CoordinateSystem::Conical, PlacementVariant::Uniform, 0.45 * width, 1};
  const auto feet = place(disc, domes, places);
  RawShape shape;
  double owed = 0;
  for (int i = 0; i < domes; ++i) {
    const double relative = places.uniform(0.6, 1.35);
    const double radius = 0.52 * width / std::sqrt(static_cast<double>(domes)) * relative;
    const double top = depth * std::clamp(0.75 * relative * places.uniform(0.75, 1.2), 0.3, 1.0);
    owed += static_cast<double>(request.puffs) / domes * relative * relative;
    const int share = std::max(2, static_cast<int>(owed));
    owed -= share;
    for (const glm::dvec3& p :
         place({CoordinateSystem::HalfSpherical, PlacementVariant::Uniform}, share, fills)) {
      Puff puff;
      const double sigma =
          std::min(0.42, 0.75 / std::cbrt(static_cast<double>(share))) * radius * fills.uniform(0.8, 1.2);
      const double sigmaY = std::min(sigma * recipe.flattening, 0.22 * top);
      puff.center =
          glm::dvec3(feet[i].x + p.x * 0.75 * radius + request.tilt * p.y * top,
                     std::clamp(0.9 * p.y * top, 1.5 * sigmaY, std::max(1.5 * sigmaY, top - 1.5 * sigmaY)),
                     feet[i].z + p.z * 0.75 * radius);
      puff.sigma = glm::vec3(sigma, sigmaY, sigma);
      puff.extinctionPerMeter = static_cast<float>(0.7 + 0.5 * p.y);
      puff.section = static_cast<std::uint16_t>(i);
      shape.puffs.push_back(puff);
    }
  }
  return shape;
}

}  // namespace

RawShape shapeHeap(const Recipe& recipe, const ShapeRequest& request) {
  if (request.depthMeters < kFlatAspect * request.widthMeters) return shapeHeapField(recipe, request);
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
    const double reach = 0.37 * width;
    const double outward = i == 0 ? 0.15 : 1.0;
    const double x = outward * p.x * reach + mainX * (1 - std::abs(p.x)),
                 z = outward * p.z * reach + mainZ * (1 - std::abs(p.z));
    const double fromMain = std::hypot(x - mainX, z - mainZ) / (0.5 * width);
    // Turrets of uneven height, the tallest over the middle, low shoulders at the rim.
    const double profile =
        std::clamp((1.0 - 0.85 * fromMain * fromMain) * places.uniform(0.42, 1.0), 0.16, 1.0);
    const double top = depth * (i == 0 ? 0.97 : profile);
    const double radius = std::min(
        recipe.sectionRadius * width * (i == 0 ? 1.35 : places.uniform(0.65, 1.25)) * (1.0 - 0.3 * fromMain),
        0.52 * top);
    for (double y = 0.4 * radius; y <= std::max(top - radius, 0.4 * radius) + 1e-9; y += 0.62 * radius) {
      // A turret narrows a little above its base and swells again in its head.
      const double share = y / std::max(top, 1e-9);
      const double swell =
          radius * (1.0 - 0.28 * std::sin(share * 3.14159265358979)) * places.uniform(0.85, 1.12);
      const double wobble = 0.28 * radius;
      lobes.push_back({{x + request.tilt * y + wobble * places.uniform(-1, 1),
                        std::min(y, depth - swell * 0.95), z + wobble * places.uniform(-1, 1)},
                       swell,
                       static_cast<std::uint16_t>(i),
                       0});
    }
  }
  if (request.puffs >= 12 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 12, 0.42, places);
  if (request.puffs >= 14 * static_cast<int>(lobes.size())) growLobes(lobes, 2, 6, 0.45, places);
  for (Lobe& lobe : lobes) lobe.center.y = std::min(lobe.center.y, depth - 0.8 * lobe.radius);
  RawShape shape;
  fillLobes(shape.puffs, lobes, recipe, request.puffs, 0, fills);
  // Liquid water grows with height above the base (adiabatic ascent).
  for (Puff& puff : shape.puffs)
    puff.extinctionPerMeter *= 0.55f + 0.45f * static_cast<float>(std::min(1.0, puff.center.y / depth));
  return shape;
}

}  // namespace cloudgen::shape
