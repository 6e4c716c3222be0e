// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

/// A thread of falling ice: it leaves a small head, drops into slower air and trails behind (Marshall 1953,
/// the geometry of mares' tails: the trail is a parabola where the shear is even).
struct Thread {
  glm::dvec3 head{0};
  double length = 1, fall = 0, heading = 0;
  double curl = 0;       ///< sideways bend at the end, as a share of the length
  double hook = 0;       ///< how far the head curls up and over, as a share of the length
  double thickness = 1;  ///< metres
  double strength = 1;

  glm::dvec3 at(double t) const {
    const double back =
        length * (std::pow(t, 1.35) - hook * std::sin(std::numbers::pi * std::min(1.0, 4 * t)));
    const double side = 0.5 * curl * length * t * t;
    return {head.x - back * std::cos(heading) - side * std::sin(heading), head.y - fall * std::pow(t, 0.7),
            head.z - back * std::sin(heading) + side * std::cos(heading)};
  }
};

constexpr double kFaintest = 0.08;  ///< of a thread's density: what is fainter would not be drawn

void addThread(std::vector<Puff>& puffs, const Thread& thread, const ShapeRequest& request, int count,
               std::uint16_t section, base::RandomStream& stream) {
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count;
    const glm::dvec3 here = thread.at(t), ahead = thread.at(std::max(0.0, t - 0.5 / count)),
                     behind = thread.at(t + 0.5 / count);
    const double step = glm::length(behind - ahead), spread = thread.thickness * (0.35 + 1.1 * t);
    Puff puff;
    puff.center =
        here + 0.5 * spread *
                   glm::dvec3(stream.gaussian() * std::sin(thread.heading), 0.25 * stream.gaussian(),
                              stream.gaussian() * std::cos(thread.heading));
    puff.sigma = glm::vec3(std::max(0.75 * step, 0.8 * spread), std::max(8.0, 0.22 * spread),
                           std::max(12.0, 0.3 * spread));
    puff.rotation = turnedAlong(glm::normalize(ahead - behind));
    const double grain =
        base::fractalNoise({here.x / (0.04 * request.widthMeters), here.y / (0.2 * request.depthMeters + 1),
                            here.z / (0.012 * request.widthMeters)},
                           3, 71);
    const double density = thread.strength * std::exp(-1.1 * t) * (1.0 - base::smoothStep(0.7, 1.1, t)) *
                           std::clamp(1.0 + 1.4 * grain, 0.15, 2.0);
    if (density < kFaintest) continue;
    puff.extinctionPerMeter = static_cast<float>(density / std::max(1.0, puff.sigma.y / 30.0));
    puff.section = section;
    puffs.push_back(puff);
  }
}

/// Between the threads hangs thinner ice that nobody sees as threads: a share of a bundle's water, drawn out
/// as they are.
void addHaze(std::vector<Puff>& puffs, const Thread& middle, double band, double depth, double share,
             std::uint16_t section) {
  constexpr int kCount = 5;
  double threads = 0;
  for (const Puff& puff : puffs)
    if (puff.section == section) threads += extinctionArea(puff);
  for (int i = 0; i < kCount; ++i) {
    Puff puff;
    const double t = (i + 0.5) / kCount;
    puff.center = middle.at(t);
    puff.sigma = glm::vec3(0.2 * middle.length, std::max(10.0, 0.14 * depth), 1.1 * band);
    puff.rotation = glm::angleAxis(static_cast<float>(-middle.heading + middle.curl * t), glm::vec3(0, 1, 0));
    puff.section = section;
    puff.extinctionPerMeter = 1;
    puff.extinctionPerMeter =
        static_cast<float>(share / (1 - share) * threads / kCount / extinctionArea(puff));
    puffs.push_back(puff);
  }
}

}  // namespace

void addStrands(std::vector<Puff>& puffs, const ShapeRequest& request, std::uint16_t section) {
  const double width = request.widthMeters, depth = request.depthMeters;
  const int count = std::clamp(request.puffs / 4, 1, 60);
  base::RandomStream stream(request.seed, request.variant, base::Purpose::ShapeDetail);
  // Strands side by side fill the width of one soft blob, or nearly.
  const double breadth = 0.29 * width * std::max(0.15, 1.3 / std::sqrt(static_cast<double>(count)));
  const double turning = stream.uniform(-0.9, 0.9);
  for (int i = 0; i < count; ++i) {
    const double x = 0.2 * width * stream.gaussian(), z = 0.28 * width * stream.gaussian();
    Puff puff;
    puff.center =
        glm::vec3(x + 0.12 * width, depth * stream.uniform(0.35, 0.65), z + turning * x * x / width);
    puff.sigma =
        glm::vec3(0.24 * width * stream.uniform(0.6, 1.2), 0.2 * depth, breadth * stream.uniform(0.8, 1.2));
    puff.rotation = turnedAlong({1, 0, 2 * turning * x / width});
    puff.extinctionPerMeter = static_cast<float>(stream.uniform(0.75, 1.0));
    puff.section = section;
    puffs.push_back(puff);
  }
}

RawShape shapeFilaments(const Recipe& recipe, const ShapeRequest& request) {
  const double width = request.widthMeters, depth = request.depthMeters;
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const int bundles = std::max(2, std::min(recipe.sections, request.puffs / 12));
  const auto points = place(recipe.sectionPlacement, bundles, places);
  const int threads = std::clamp(request.puffs / (bundles * 20), 1, 34);
  const int perThread = std::max(4, request.puffs / (bundles * threads));
  // A few threads stand for many: they are broader.
  const double breadth = std::sqrt(34.0 / threads);
  // The fewer the threads, the more of the ice is told without them; beside many it would be too faint to be
  // drawn.
  constexpr double kFaintestHaze = 0.04;
  const double hazeShare = std::min(12.0 / request.puffs, 0.3);
  // Bundles of one cloud bend the same way: the wind turns with height.
  const double turning = places.uniform(0.25, 0.7) * (places.uniform() < 0.5 ? -1 : 1);
  RawShape shape;
  for (int b = 0; b < bundles; ++b) {
    const auto section = static_cast<std::uint16_t>(b);
    const double band = 0.018 * width * places.uniform(0.4, 1.6);
    Thread middle;
    middle.head = {points[b].x * 0.32 * width + 0.36 * width, 0.84 * depth, points[b].z * 0.38 * width};
    middle.length = width * places.uniform(0.45, 1.0);
    middle.heading = 0.14 * places.gaussian();
    middle.curl = turning * places.uniform(0.6, 1.3);
    middle.fall = std::min(0.85 * middle.head.y, 0.8 * depth) * places.uniform(0.7, 1.0);
    middle.hook = places.uniform() < 0.5 ? 0.03 : 0.0;
    for (int i = 0; i < threads; ++i) {
      const double aside = band * fills.gaussian();
      Thread thread = middle;
      thread.head += glm::dvec3(2.0 * band * fills.gaussian() - middle.heading * aside,
                                depth * fills.uniform(-0.14, 0.14), aside);
      thread.length *= fills.uniform(0.45, 1.1);
      thread.heading += 0.04 * fills.gaussian();
      thread.curl += 0.12 * fills.gaussian();
      thread.fall *= fills.uniform(0.7, 1.0);
      thread.thickness = breadth * recipe.sectionRadius * width * fills.uniform(0.5, 1.3);
      thread.strength =
          std::max(0.3, std::exp(-0.5 * (aside / band) * (aside / band))) * fills.uniform(0.5, 1.0);
      addThread(shape.puffs, thread, request, perThread, section, fills);
    }
    if (hazeShare > kFaintestHaze) addHaze(shape.puffs, middle, band, depth, hazeShare, section);
  }
  return shape;
}

}  // namespace cloudgen::shape
