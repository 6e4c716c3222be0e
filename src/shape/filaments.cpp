// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

/// A thread of falling ice: it leaves a small head, drops into slower air and trails behind (Marshall 1953,
/// the geometry of mares' tails: the trail is a parabola where the shear is even).
void addThread(std::vector<Puff>& puffs, const ShapeRequest& request, const Recipe& recipe,
               const glm::dvec3& head, double length, double heading, double breadth, int count,
               double strength, std::uint16_t section, base::RandomStream& stream) {
  const double depth = request.depthMeters;
  const double fall = std::min(0.85 * head.y, 0.8 * depth) * stream.uniform(0.6, 1.0);
  const double curl = stream.uniform(-0.35, 0.35);
  const double thickness = breadth * recipe.sectionRadius * request.widthMeters * stream.uniform(0.5, 1.3);
  const double cosine = std::cos(heading), sine = std::sin(heading);
  const auto pointAt = [&](double t) {
    const double back = length * std::pow(t, 1.35);
    const double side = curl * length * t * t * 0.5;
    return glm::dvec3(head.x - back * cosine - side * sine, head.y - fall * std::pow(t, 0.75),
                      head.z - back * sine + side * cosine);
  };
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count;
    const glm::dvec3 here = pointAt(t), ahead = pointAt(std::max(0.0, t - 0.5 / count)),
                     behind = pointAt(t + 0.5 / count);
    const double step = glm::length(behind - ahead);
    const double spread = thickness * (0.35 + 1.1 * t);
    Puff puff;
    puff.center = here + glm::dvec3(stream.gaussian() * spread * sine, 0.25 * spread * stream.gaussian(),
                                    stream.gaussian() * spread * cosine) *
                             0.5;
    puff.sigma = glm::vec3(std::max(step * 0.75, thickness * 0.5), std::max(8.0, 0.22 * spread),
                           std::max(12.0, 0.3 * spread));
    puff.rotation = turnedAlong(glm::normalize(ahead - behind));
    const double grain =
        base::fractalNoise({here.x / (0.04 * request.widthMeters), here.y / (0.2 * depth + 1),
                            here.z / (0.012 * request.widthMeters)},
                           3, 71);
    puff.extinctionPerMeter =
        static_cast<float>(strength * std::exp(-2.2 * t) * std::clamp(1.0 + 1.4 * grain, 0.15, 2.0) /
                           std::max(1.0, puff.sigma.y / 30.0));
    puff.section = section;
    puffs.push_back(puff);
  }
}

/// Between the threads hangs thinner ice that nobody sees as threads: a share of a bundle's water.
void addHaze(std::vector<Puff>& puffs, const glm::dvec3& at, double length, double band, double depth,
             double share, std::uint16_t section) {
  constexpr int kCount = 5;
  double threads = 0;
  for (const Puff& puff : puffs)
    if (puff.section == section) threads += extinctionArea(puff);
  for (int i = 0; i < kCount; ++i) {
    Puff puff;
    const double t = (i + 0.5) / kCount;
    puff.center = glm::vec3(at.x - 0.8 * t * length, (0.72 - 0.4 * t) * depth, at.z);
    puff.sigma = glm::vec3(0.16 * length, std::max(10.0, 0.14 * depth), std::max(1.3 * band, 0.06 * length));
    puff.section = section;
    puff.extinctionPerMeter = 1;
    puff.extinctionPerMeter =
        static_cast<float>(share / (1 - share) * threads / kCount / extinctionArea(puff));
    puffs.push_back(puff);
  }
}

}  // namespace

RawShape shapeFilaments(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const int bundles = std::max(2, std::min(recipe.sections, request.puffs / 12));
  const auto points = place(recipe.sectionPlacement, bundles, places);
  const int threads = std::clamp(request.puffs / (bundles * 14), 1, 34);
  const int perThread = std::max(4, request.puffs / (bundles * threads));
  // A few threads stand for many: they are broader.
  const double breadth = std::sqrt(34.0 / threads);
  // The fewer the threads, the more of the ice is told without them.
  const double hazeShare = std::clamp(12.0 / request.puffs, 0.04, 0.3);
  RawShape shape;
  for (int b = 0; b < bundles; ++b) {
    const glm::dvec3 at(points[b].x * 0.36 * width + 0.18 * width, 0, points[b].z * 0.36 * width);
    const double length = width * places.uniform(0.28, 0.62);
    const double turn = 0.16 * places.gaussian();
    const double band = 0.05 * width * places.uniform(0.5, 1.4);
    for (int i = 0; i < threads; ++i) {
      const double aside = band * fills.gaussian();
      const glm::dvec3 head(at.x + 0.5 * band * fills.gaussian() - turn * aside,
                            depth * fills.uniform(0.7, 0.98), at.z + aside);
      const double strength = std::exp(-0.5 * (aside / band) * (aside / band)) * fills.uniform(0.35, 1.0);
      addThread(shape.puffs, request, recipe, head, length * fills.uniform(0.5, 1.0),
                turn + 0.03 * fills.gaussian(), breadth, perThread, strength, static_cast<std::uint16_t>(b),
                fills);
    }
    addHaze(shape.puffs, at, length, band, depth, hazeShare, static_cast<std::uint16_t>(b));
  }
  return shape;
}

}  // namespace cloudgen::shape
