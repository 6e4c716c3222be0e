// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

constexpr double kTrunk = -0.24;    ///< the updraught stands upwind of the middle, in widths
constexpr double kAnvilTop = 0.88;  ///< in depths: the dome overshoots by the rest

/// Radius of the updraught's column in widths at a share of the depth: broad foot, then spreading under the
/// anvil.
double columnRadius(double share) {
  return 0.08 + 0.025 * (1.0 - base::smoothStep(0.0, 0.4, share)) + 0.02 * base::smoothStep(0.6, 0.9, share);
}

/// Rising bubbles wound about a filled core, and the dome that shoots over the anvil.
void addColumn(std::vector<Lobe>& lobes, const Recipe& recipe, const ShapeRequest& request, int rings,
               int turrets, base::RandomStream& stream) {
  constexpr double kTop = 0.71, kPuffsOfOne = 690;
  // Told by few puffs it stands for several towers.
  const double broad = 1.09 * std::clamp(std::pow(kPuffsOfOne / request.puffs, 0.28), 1.0, 1.65);
  const double width = request.widthMeters, depth = request.depthMeters;
  const auto axis = [&](double y) { return kTrunk * width + 0.35 * request.tilt * y; };
  for (int ring = 0; ring < rings; ++ring) {
    const double share = (ring + 0.5) / rings * kTop;
    const double column = broad * columnRadius(share) * width;
    const auto section = static_cast<std::uint16_t>(ring * 8 / rings);
    const double turn = 2.0 * std::numbers::pi * stream.uniform();
    lobes.push_back({{axis(share * depth), share * depth, 0}, 0.75 * column, section, 0, {0, 1, 0}});
    for (int turret = 0; turret < turrets; ++turret) {
      const double angle = turn + 2.0 * std::numbers::pi * (turret + stream.uniform(0, 0.7)) / turrets;
      Lobe lobe;
      lobe.radius = recipe.sectionRadius * width * stream.uniform(0.4, 0.85) * (column / (0.12 * width));
      const double out = column - 0.55 * lobe.radius * stream.uniform(0.4, 1.3);
      const double y =
          std::max(0.3 * lobe.radius, (share + stream.uniform(-0.5, 0.5) * kTop / rings) * depth);
      lobe.center = {axis(y) + out * std::cos(angle), y, out * std::sin(angle)};
      lobe.section = section;
      lobe.facing = glm::normalize(glm::dvec3(std::cos(angle), 0.7, std::sin(angle)));
      lobes.push_back(lobe);
    }
  }
  // The dome that overshoots: where the updraught is strongest, a cluster with the tallest in the middle.
  const double dome = std::min(0.06 * width, 0.085 * depth);
  for (int bubble = 0; bubble < 8; ++bubble) {
    const double angle = 2.0 * std::numbers::pi * (bubble + stream.uniform(0, 0.6)) / 7;
    const double radius = bubble == 0 ? dome : dome * stream.uniform(0.5, 0.75);
    const double out = bubble == 0 ? 0 : dome * stream.uniform(0.7, 1.2);
    const double y = bubble == 0 ? depth - dome : kAnvilTop * depth + dome * stream.uniform(-0.4, 0.35);
    lobes.push_back({{axis(depth) + out * std::cos(angle), y, out * std::sin(angle)},
                     radius,
                     7,
                     0,
                     glm::normalize(glm::dvec3(std::cos(angle), 1, std::sin(angle)))});
  }
}

/// A line of lesser towers on the upwind side, the lower the further they are from the column.
void addFlankingLine(std::vector<Lobe>& lobes, const ShapeRequest& request, int towers,
                     base::RandomStream& stream) {
  const double width = request.widthMeters, depth = request.depthMeters;
  const double heading = stream.uniform(0.5, 1.0) * (stream.uniform() < 0.5 ? -1 : 1);
  for (int i = 0; i < towers; ++i) {
    const double along = (i + stream.uniform(0.4, 1.0)) / towers;
    const double out = (0.1 + 0.2 * along) * width;
    Lobe foot;
    foot.radius = width * (0.062 - 0.028 * along) * stream.uniform(0.8, 1.2);
    foot.center = {kTrunk * width - out * std::cos(heading), 0.1 * foot.radius,
                   out * std::sin(heading) + 0.03 * width * stream.uniform(-1, 1)};
    foot.section = 8;
    foot.facing = glm::normalize(glm::dvec3(-0.4, 1, 0.4 * std::sin(heading)));
    raiseTurret(lobes, foot, depth * (0.5 - 0.37 * along) * stream.uniform(0.8, 1.1), 0.3 * request.tilt,
                stream);
  }
}

constexpr double kUpwindReach = 0.16, kAnvilLength = 1.05;  ///< of the anvil, in widths

/// Height of the anvil's underside in depths: it rises from the column to all sides.
double anvilUnderside(double along, double across) {
  constexpr double kColumn = kUpwindReach / kAnvilLength;
  const double away = along < kColumn
                          ? base::smoothStep(0.2 * kColumn, kColumn, kColumn - along + 0.2 * kColumn)
                          : base::smoothStep(0.0, 0.5, along - kColumn);
  return 0.68 + 0.14 * away + 0.06 * across * across;
}

/// Half the anvil's breadth in widths, at a share of its length downwind.
double anvilHalfBreadth(double along) { return 0.12 + 0.27 * std::sqrt(along); }

/// The anvil: a wedge that the wind draws out, thick over the column, thin and torn into fibres at its far
/// end; more than half of it overhangs. Fibres diverge as the outflow does.
void addAnvil(std::vector<Puff>& puffs, const ShapeRequest& request, int count, base::RandomStream& stream) {
  const double width = request.widthMeters, depth = request.depthMeters;
  const double start = (kTrunk - kUpwindReach) * width + 0.3 * request.tilt * depth;
  const double spacing = std::sqrt(0.6 * kAnvilLength / count) * width;
  constexpr double kThinning = 3.0;
  const double widest = 0.05 * width;
  const std::uint64_t noiseSeed = request.seed * 43 + request.variant;
  for (int i = 0; i < count; ++i) {
    // Fewer and larger puffs where it is thin: the faintest could not be drawn.
    const double along = -std::log(1.0 - stream.uniform() * (1.0 - std::exp(-kThinning))) / kThinning;
    const double across = stream.uniform(-1, 1), larger = 1.0 + 3.0 * along;
    // How far a fibre reaches, and how dense it is, goes by where it starts.
    const double reach =
        0.85 - 0.35 * across * across + 0.7 * base::fractalNoise({5.0 * across, 0.7, 0.5}, 3, noiseSeed);
    const double streak = base::fractalNoise({11.0 * across, 1.6 * along, 3.1}, 3, noiseSeed + 1);
    const double rim = 1.0 - base::smoothStep(0.4, 1.0, std::abs(across) + 0.4 * streak);
    const double thin = 1.0 - base::smoothStep(reach - 0.7, reach + 0.15, along);
    const double upwind = base::smoothStep(0.0, 0.1, along);
    const double upper = kAnvilTop - 0.015 * along - 0.02 * across * across;
    const double lower = std::min(upper - 0.015, anvilUnderside(along, across) + 0.05 * streak);
    const double half = anvilHalfBreadth(along);
    // Flat, as a part of a sheet that is lit from above as a whole.
    const double sigmaX = std::min(1.1 * spacing * larger, 2 * widest);
    const double sigmaY = std::max(std::min(0.16 * (upper - lower) * depth, 0.22 * sigmaX), 20.0);
    // Its top is level, so that the dome stands over it.
    const double y = std::min(depth * (lower + (upper - lower) * stream.uniform()), depth * upper - 1.2 * sigmaY);
    Puff puff;
    puff.center = glm::dvec3(start + along * kAnvilLength * width, y, across * half * width);
    puff.sigma = glm::vec3(sigmaX, sigmaY, std::min(0.5 * spacing * larger, widest) * stream.uniform(0.7, 1.3));
    const double diverging = across * 0.13 / std::sqrt(along + 0.05) / kAnvilLength;
    puff.rotation = turnedAlong({1, 0.03 * stream.gaussian(), diverging});
    puff.extinctionPerMeter =
        static_cast<float>(1.3 * std::exp(-2.7 * along) * thin * rim * upwind *
                           std::clamp(0.95 + (1.2 + 2.5 * along) * streak, 0.03, 2.2) / puff.sigma.y);
    puff.section = 9;
    puffs.push_back(puff);
  }
}

/// Ice that falls from the anvil's underside and evaporates: faint threads that trail upwind.
void addFallstreaks(std::vector<Puff>& puffs, const ShapeRequest& request, int count,
                    base::RandomStream& stream) {
  const double width = request.widthMeters, depth = request.depthMeters;
  for (int i = 0; i < count; ++i) {
    const double along = 0.8 * stream.uniform() * stream.uniform(), across = stream.uniform(-0.8, 0.8);
    const double fall = depth * stream.uniform(0.02, 0.07);
    Puff puff;
    puff.center = glm::dvec3(
        (kTrunk - kUpwindReach + kAnvilLength * along) * width + 0.3 * request.tilt * depth,
        anvilUnderside(along, across) * depth - 0.6 * fall, across * anvilHalfBreadth(along) * width);
    puff.sigma = glm::vec3(fall, 0.25 * fall, 0.006 * width);
    puff.rotation = turnedAlong({1, 0.7, 0});
    puff.extinctionPerMeter = static_cast<float>(0.25 * std::exp(-4.0 * along) / puff.sigma.y);
    puff.section = 9;
    puffs.push_back(puff);
  }
}

double extinctionAreaOf(std::span<const Puff> puffs) {
  double sum = 0;
  for (const Puff& puff : puffs) sum += extinctionArea(puff);
  return sum;
}

/// However many puffs tell the tower and its anvil, this share of all is in the anvil, or its brightness would change
/// with them.
void shareWithAnvil(std::span<Puff> tower, std::span<Puff> anvil) {
  constexpr double kAnvilShare = 0.15;
  const double factor =
      kAnvilShare / (1 - kAnvilShare) * extinctionAreaOf(tower) / std::max(extinctionAreaOf(anvil), 1e-30);
  for (Puff& puff : anvil) puff.extinctionPerMeter *= static_cast<float>(factor);
}

}  // namespace

RawShape shapeTower(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const int affordable = request.puffs / std::max(1, recipe.billboards);
  const int rings = std::clamp(affordable / 4, 4, recipe.sections);
  std::vector<Lobe> lobes;
  addColumn(lobes, recipe, request, rings, std::clamp(affordable / rings, 2, 6), places);
  addFlankingLine(lobes, request, std::clamp(affordable / 10, 1, 6), places);
  if (request.puffs >= 14 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 8, 0.46, places);
  if (request.puffs >= 14 * static_cast<int>(lobes.size())) growLobes(lobes, 2, 6, 0.46, places);
  reachTo(lobes, depth);

  RawShape shape;
  fillLobes(shape.puffs, lobes, recipe, static_cast<int>(0.68 * request.puffs), 0, fills);
  for (Puff& puff : shape.puffs)
    puff.extinctionPerMeter *= 0.8f + 0.4f * static_cast<float>(puff.center.y / depth);
  const std::size_t towerPuffs = shape.puffs.size();
  addAnvil(shape.puffs, request, std::max(20, static_cast<int>(0.24 * request.puffs)), fills);
  addFallstreaks(shape.puffs, request, static_cast<int>(0.04 * request.puffs), fills);
  shareWithAnvil(std::span(shape.puffs).first(towerPuffs), std::span(shape.puffs).subspan(towerPuffs));
  addPrecipitation(shape.precipitation, recipe, {(kTrunk + 0.02) * width, 0, 0}, 0.1 * width, 0.11 * depth,
                   std::max(6, static_cast<int>(0.04 * request.puffs)), fills);
  for (Puff& puff : shape.precipitation) puff.section = 10;
  return shape;
}

}  // namespace cloudgen::shape
