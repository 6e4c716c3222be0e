// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

/// Radius of the updraught's column at a height share: broad foot, waist, spreading under the anvil.
double columnRadius(double share) {
  return 0.098 + 0.035 * std::pow(1.0 - share, 2.0) + 0.04 * base::smoothStep(0.65, 1.0, share);
}

/// Fibres of ice that leave the top of the column on all sides, mostly downwind, thinning outwards.
void addAnvil(std::vector<Puff>& puffs, const ShapeRequest& request, double trunkX, std::uint16_t section,
              int count, base::RandomStream& stream) {
  const double width = request.widthMeters, depth = request.depthMeters;
  const double level = 0.87 * depth, thickness = 0.12 * depth;
  const int perFibre = std::max(4, std::min(26, count / 60));
  for (int fibre = 0; fibre < count / perFibre; ++fibre) {
    // Headings crowd downwind (+x): the heading's density is 1 + 0.75 cos.
    double heading = 0;
    do heading = stream.uniform(-std::numbers::pi, std::numbers::pi);
    while (stream.uniform() > (1.0 + 0.75 * std::cos(heading)) / 1.75);
    const double downwind = 0.5 + 0.5 * std::cos(heading);
    const double lobed =
        1.0 + 0.35 * base::fractalNoise(
                         {2.2 * std::cos(heading), 2.2 * std::sin(heading), request.variant * 7.1}, 3, 61);
    const double reach = width * (0.27 + 0.42 * downwind * downwind) * lobed * stream.uniform(0.5, 1.0);
    const double start = 0.10 * width * std::sqrt(stream.uniform());
    const double lift = stream.uniform(-0.5, 0.5);
    const double bend = 0.5 * std::sin(heading);
    for (int i = 0; i < perFibre; ++i) {
      const double along = (i + stream.uniform()) / perFibre;
      const double r = start + along * (reach - start);
      const double turned = heading - bend * along * 0.55;
      const double thin = 1.0 - 0.72 * along;
      const double y = level + thickness * (lift * thin + 0.45 * along) - 0.03 * depth * (1 - along);
      Puff puff;
      puff.center = glm::dvec3(trunkX + r * std::cos(turned), y, r * std::sin(turned));
      const double length = 0.62 * (reach - start) / perFibre + 0.014 * width;
      puff.sigma =
          glm::vec3(length, thickness * 0.24 * thin + 20, 0.012 * width + 0.018 * width * stream.uniform());
      puff.rotation = turnedAlong({std::cos(turned), 0.04, std::sin(turned)});
      const double streak = base::fractalNoise({heading * 9.0, along * 1.6, lift}, 3, 67);
      puff.extinctionPerMeter = static_cast<float>((0.5 * thin * thin + 0.04) *
                                                   std::clamp(0.8 + 1.6 * streak, 0.08, 1.8) / puff.sigma.y);
      puff.section = section;
      puffs.push_back(puff);
    }
  }
}

}  // namespace

RawShape shapeTower(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const double trunkX = -0.16 * width;
  const auto leaning = [&](double y) {
    return trunkX + request.tilt * 0.35 * y + 0.05 * width * base::smoothStep(0.4, 1.0, y / depth);
  };

  // The column: lobes placed in a cylinder of the recipe's system, wound upwards.
  std::vector<Lobe> lobes;
  const int sections = std::max(6, std::min(recipe.sections, request.puffs / std::max(1, recipe.billboards)));
  const auto points = place(recipe.sectionPlacement, sections, places);
  for (int i = 0; i < sections; ++i) {
    const double share = (i + 0.5) / sections;
    const double y = 0.03 * depth + share * 0.76 * depth;
    const double column = columnRadius(share) * width;
    // A filled core, and rising turrets on its surface that show.
    const auto section = static_cast<std::uint16_t>(i * 8 / sections);
    lobes.push_back({{leaning(y), y, 0}, 0.78 * column, section, 0});
    for (int turret = 0; turret < 3; ++turret) {
      const double angle = 2.0 * std::numbers::pi * (places.uniform() + turret / 3.0);
      const double radius = recipe.sectionRadius * width * places.uniform(0.45, 1.0) * (1.0 - 0.25 * share);
      const double out = column * places.uniform(0.62, 0.95) + 0.12 * radius * (points[i].x + points[i].z);
      lobes.push_back({{leaning(y) + out * std::cos(angle), y + radius * places.uniform(-0.5, 0.5),
                        out * std::sin(angle)},
                       radius,
                       section,
                       0});
    }
  }
  // An overshooting dome above the anvil, and flanking towers on the upwind side.
  lobes.push_back({{leaning(0.89 * depth), 0.89 * depth, 0}, 0.045 * width, 7, 0});
  for (int i = 0; i < sections / 3; ++i) {
    const double out = places.uniform(0.18, 0.34) * width, side = places.uniform(-0.2, 0.2) * width;
    const double top = depth * std::max(0.08, 0.42 - 0.95 * out / width) * places.uniform(0.75, 1.1);
    const double radius = 0.055 * width * places.uniform(0.7, 1.2);
    for (double y = 0.35 * radius; y < top; y += 0.8 * radius)
      lobes.push_back({{trunkX - out + 0.1 * y, y, side}, radius * (1 - 0.35 * y / top), 8, 0});
  }
  if (request.puffs >= 14 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 11, 0.42, places);
  if (request.puffs >= 40 * static_cast<int>(lobes.size())) growLobes(lobes, 2, 5, 0.45, places);

  RawShape shape;
  fillLobes(shape.puffs, lobes, recipe, static_cast<int>(0.70 * request.puffs), 0, fills);
  for (Puff& puff : shape.puffs)
    puff.extinctionPerMeter *= 0.8f + 0.4f * static_cast<float>(puff.center.y / depth);
  addAnvil(shape.puffs, request, leaning(0.86 * depth), 9,
           std::max(24, static_cast<int>(0.26 * request.puffs)), fills);
  addPrecipitation(shape.precipitation, recipe, {trunkX + 0.02 * width, 0.02 * depth, 0}, 0.13 * width,
                   0.11 * depth, std::max(6, static_cast<int>(0.04 * request.puffs)), fills);
  for (Puff& puff : shape.precipitation) puff.section = 10;
  return shape;
}

}  // namespace cloudgen::shape
