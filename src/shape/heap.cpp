// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shape/forms.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::shape {

namespace {

constexpr double kFlatAspect = 0.3;
constexpr double kShreds = 0.1;  ///< of the puffs, where the recipe is ragged throughout
constexpr double kSunk =
    0.1;  ///< of a foot's radius: its middle above the base, which cuts it where it is widest

/// Where a heap stands, how large it is and of how many turrets.
struct Heap {
  double x = 0, z = 0, width = 1, depth = 1;
  int turrets = 1;
  std::uint16_t firstSection = 0;
};

/// One main turret off the middle, lesser ones leaning on it, low shoulders at the rim: the taller the heap
/// is for its width, the steeper. All stand on one level.
void addHeap(std::vector<Lobe>& lobes, const Heap& heap, const Recipe& recipe, double tilt,
             base::RandomStream& stream) {
  const double steepness = std::clamp(heap.depth / heap.width, 0.4, 1.4);
  const double mainX = stream.uniform(-0.1, 0.1) * heap.width, mainZ = stream.uniform(-0.1, 0.1) * heap.width;
  const auto points = place(recipe.sectionPlacement, heap.turrets, stream);
  // Few turrets stand for many: they are wider.
  const double wider = std::max(1.0, 2.0 / std::pow(heap.turrets, 0.45));
  for (int i = 0; i < heap.turrets; ++i) {
    const bool main = i == 0;
    const glm::dvec2 aside = main ? glm::dvec2(0) : glm::dvec2(points[i].x, points[i].z);
    const double out = glm::length(aside);
    const double profile = (1.0 - 0.8 * std::pow(out, 1.0 / steepness)) * stream.uniform(0.35, 1.0);
    const double top = heap.depth * (main ? 1.0 : std::clamp(profile, 0.12, 0.88));
    const double widest = wider * recipe.sectionRadius * heap.width *
                          (main ? 1.3 : stream.uniform(0.65, 1.25)) * (1.0 - 0.2 * out);
    Lobe foot;
    foot.radius = std::min(widest, 0.8 * top);
    foot.center = {heap.x + mainX * (1 - out) + 0.38 * heap.width * aside.x, kSunk * foot.radius,
                   heap.z + mainZ * (1 - out) + 0.38 * heap.width * aside.y};
    foot.section = static_cast<std::uint16_t>(heap.firstSection + i);
    foot.facing = glm::normalize(glm::dvec3(1.2 * aside.x, 0.75, 1.2 * aside.y));
    raiseTurret(lobes, foot, top, tilt, stream);
  }
}

/// A cloud much wider than tall stands for a field of heaps side by side, of many sizes.
void addField(std::vector<Lobe>& lobes, const Recipe& recipe, const ShapeRequest& request, int heaps,
              base::RandomStream& stream) {
  const double width = request.widthMeters, depth = request.depthMeters;
  const int turrets = std::clamp(request.puffs / (heaps * recipe.billboards * 2), 1, 5);
  const Placement disc{CoordinateSystem::Conical, PlacementVariant::Uniform, 0.45 * width, 1};
  const auto feet = place(disc, heaps, stream);
  for (int i = 0; i < heaps; ++i) {
    const double relative = stream.uniform(0.6, 1.35);
    Heap heap{feet[i].x, feet[i].z, 1.8 * width / std::sqrt(static_cast<double>(heaps)) * relative};
    heap.depth = depth * std::clamp(0.75 * relative * stream.uniform(0.75, 1.2), 0.3, 1.0);
    heap.turrets = turrets;
    heap.firstSection = static_cast<std::uint16_t>(i * turrets);
    addHeap(lobes, heap, recipe, request.tilt, stream);
  }
}

/// Fractus and shreds: small thin rags in clumps, beside the foot and in the lee of the turrets, where dry
/// air tears the cloud.
void addShreds(std::vector<Puff>& puffs, const std::vector<Lobe>& lobes, int count,
               base::RandomStream& stream) {
  constexpr int kOfClump = 12;
  std::vector<const Lobe*> turrets;
  for (const Lobe& lobe : lobes)
    if (lobe.level == 0) turrets.push_back(&lobe);
  for (int made = 0; made < count; made += kOfClump) {
    const Lobe& lobe = *turrets[stream.index(static_cast<int>(turrets.size()))];
    const double angle = 2.0 * std::numbers::pi * stream.uniform();
    const double size = lobe.radius * stream.uniform(0.15, 0.4);
    const double out = lobe.radius * stream.uniform(1.0, 1.3) + size;
    const glm::dvec3 middle(lobe.center.x + out * std::cos(angle),
                            std::max(1.2 * size, lobe.center.y * stream.uniform(0.3, 1.0)),
                            lobe.center.z + out * std::sin(angle));
    for (int i = 0; i < std::min(kOfClump, count - made); ++i) {
      Puff puff;
      const double sigma = size * stream.uniform(0.3, 0.6);
      puff.center = middle + size * glm::dvec3(0.9 * stream.gaussian(), 0.35 * stream.gaussian(),
                                               0.7 * stream.gaussian());
      puff.center.y = std::max(puff.center.y, static_cast<float>(1.5 * sigma));
      puff.sigma = glm::vec3(1.3 * sigma, 0.7 * sigma, sigma);
      puff.extinctionPerMeter = static_cast<float>(stream.uniform(0.1, 0.45) / puff.sigma.y);
      puff.section = lobe.section;
      puffs.push_back(puff);
    }
  }
}

int heapsOfField(const ShapeRequest& request) {
  const double natural = std::pow(request.widthMeters / (1.6 * request.depthMeters), 2.0);
  return std::clamp(static_cast<int>(natural), 3, 400);
}

/// A field that the budget cannot tell heap by heap is told by the moments of several, wide enough to leave
/// no gaps between them.
void tellByFew(std::vector<Puff>& puffs, int count) {
  const auto wider = static_cast<float>(
      std::min(2.0, std::pow(static_cast<double>(puffs.size()) / std::max(1, count), 0.3)));
  puffs = reduce(puffs, std::max(1, count));
  for (Puff& puff : puffs) {
    puff.sigma *= glm::vec3(wider, 1, wider);
    puff.extinctionPerMeter /= wider * wider;
  }
}

}  // namespace

RawShape shapeHeap(const Recipe& recipe, const ShapeRequest& request) {
  constexpr int kPuffsOfHeap = 10;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  std::vector<Lobe> lobes;
  int puffs = request.puffs;
  if (request.depthMeters < kFlatAspect * request.widthMeters) {
    const int heaps = heapsOfField(request);
    addField(lobes, recipe, request, heaps, places);
    puffs = std::max(puffs, kPuffsOfHeap * heaps);
  } else {
    const int affordable = std::max(3, request.puffs / std::max(1, recipe.billboards));
    addHeap(lobes, {0, 0, request.widthMeters, request.depthMeters, std::min(recipe.sections, affordable), 0},
            recipe, request.tilt, places);
  }
  if (puffs >= 12 * static_cast<int>(lobes.size())) growLobes(lobes, 1, 9, 0.46, places);
  if (puffs >= 12 * static_cast<int>(lobes.size())) growLobes(lobes, 2, 7, 0.46, places);
  reachTo(lobes, request.depthMeters);
  RawShape shape;
  const int shreds = static_cast<int>(kShreds * recipe.raggedness * puffs);
  fillLobes(shape.puffs, lobes, recipe, puffs - shreds, 0, fills);
  addShreds(shape.puffs, lobes, shreds, fills);
  // Liquid water grows with height above the base (adiabatic ascent).
  for (Puff& puff : shape.puffs)
    puff.extinctionPerMeter *=
        0.4f + 0.6f * static_cast<float>(std::min(1.0, puff.center.y / request.depthMeters));
  if (puffs > request.puffs) tellByFew(shape.puffs, request.puffs);
  return shape;
}

}  // namespace cloudgen::shape
