// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

/// Those of the lobes that may bury a point of the surface of one of them.
std::vector<Lobe> buryingAbout(const Lobe& own, const std::vector<Lobe>& lobes) {
  constexpr double kFurthest = 1.25;  ///< of its radius, that a puff stands from a lobe's middle
  std::vector<Lobe> near;
  for (const Lobe& lobe : lobes) {
    if (lobe.level > own.level || &lobe == &own) continue;
    const glm::dvec3 away = own.center - lobe.center;
    const double reach = kFurthest * own.radius + lobe.radius;
    if (glm::dot(away, away) < reach * reach) near.push_back(lobe);
  }
  return near;
}

/// True if another lobe covers the point so deeply that nobody would see a puff there.
bool buried(const glm::dvec3& point, const std::vector<Lobe>& lobes, const Lobe& own) {
  for (const Lobe& lobe : lobes) {
    if (lobe.level > own.level || &lobe == &own) continue;
    const glm::dvec3 away = point - lobe.center;
    if (glm::dot(away, away) < 0.5 * lobe.radius * lobe.radius) return true;
  }
  return false;
}

}  // namespace

void growLobes(std::vector<Lobe>& lobes, int level, int children, double ratio, base::RandomStream& stream) {
  const std::vector<Lobe> parents = lobes;
  for (const Lobe& parent : parents) {
    if (parent.level != level - 1) continue;
    for (int child = 0; child < children; ++child) {
      Lobe grown;
      grown.facing = glm::normalize(stream.direction() + 0.75 * parent.facing);
      grown.radius = parent.radius * ratio * stream.uniform(0.55, 1.3);
      grown.center = parent.center + grown.facing * (parent.radius * stream.uniform(0.78, 1.02));
      grown.section = parent.section;
      grown.level = level;
      if (grown.center.y > 0.3 * grown.radius && !buried(grown.center, parents, parent))
        lobes.push_back(grown);
    }
  }
}

void raiseTurret(std::vector<Lobe>& lobes, const Lobe& foot, double top, double lean,
                 base::RandomStream& stream) {
  constexpr double kNarrowing = 0.45;
  Lobe lobe = foot;
  glm::dvec2 aside(0);
  for (double y = foot.center.y;;) {
    lobe.radius = foot.radius * (1.0 - kNarrowing * y / top) * stream.uniform(0.9, 1.1);
    lobe.center = {foot.center.x + aside.x + lean * y, y, foot.center.z + aside.y};
    lobes.push_back(lobe);
    const double next = y + 0.55 * lobe.radius;
    if (next + foot.radius * (1.0 - kNarrowing) > top) break;
    aside += 0.3 * lobe.radius * glm::dvec2(stream.uniform(-1, 1), stream.uniform(-1, 1));
    y = next;
  }
}

void reachTo(std::vector<Lobe>& lobes, double heightMeters) {
  double factor = 1e30;
  for (const Lobe& lobe : lobes)
    factor = std::min(factor, std::max(0.3, (heightMeters - lobe.radius) / std::max(lobe.center.y, 1e-6)));
  for (Lobe& lobe : lobes) lobe.center.y *= factor;
}

void fillLobes(std::vector<Puff>& puffs, const std::vector<Lobe>& lobes, const Recipe& recipe, int count,
               double floorMeters, base::RandomStream& stream) {
  double total = 0;
  for (const Lobe& lobe : lobes) total += lobe.radius * lobe.radius;
  const int finest =
      std::max_element(lobes.begin(), lobes.end(), [](auto& a, auto& b) { return a.level < b.level; })->level;
  const double noiseScale = 1.0 / (0.6 * lobes.front().radius);
  double owed = 0;
  for (const Lobe& lobe : lobes) {
    owed += count * lobe.radius * lobe.radius / total;
    int share = static_cast<int>(owed);
    if (lobe.level == 0) share = std::max(share, 1);
    owed -= share;
    // A puff covers its share of the lobe's surface, but not more than the recipe's size.
    const double spacing = lobe.radius * std::sqrt(4.0 * std::numbers::pi / std::max(1, share));
    // Few are large and stand further in, so that the lobe ends where it ends with many.
    const double size =
        std::min(lobe.radius * std::max(1.25 * recipe.billboardSize,
                                        0.4 / std::cbrt(static_cast<double>(std::max(1, share)))),
                 0.62 * spacing);
    const double shell = std::max(0.2, 1.0 - 1.3 * size / lobe.radius);
    const std::vector<Lobe> burying = share > 0 ? buryingAbout(lobe, lobes) : std::vector<Lobe>();
    for (int i = 0; i < share; ++i) {
      const bool surface = stream.uniform() < (lobe.level == finest ? 0.88 : 0.7);
      glm::dvec3 position{};
      for (int attempt = 0; attempt < 6; ++attempt) {
        glm::dvec3 direction = stream.direction();
        if (recipe.billboardPlacement.system == CoordinateSystem::HalfSpherical)
          direction.y = std::abs(direction.y);
        const double depth =
            surface ? shell * stream.uniform(0.92, 1.08) : shell * std::cbrt(stream.uniform());
        // Billows in the surface: round heaps between sharp creases.
        const glm::dvec3 onSurface = lobe.center + direction * lobe.radius;
        const double bulge = 0.88 + 0.75 * (base::billowNoise(onSurface * noiseScale * 2.1, 4, 17) - 0.70);
        position = lobe.center + direction * (lobe.radius * depth * bulge);
        if (!surface || !buried(position, burying, lobe)) break;
      }
      const bool wisp = lobe.level == finest && stream.uniform() < 0.09 * recipe.raggedness * 3.0;
      double sigma = (surface ? size : std::max(size, 0.3 * lobe.radius)) * stream.uniform(0.7, 1.25);
      double density = surface ? 1.0 : 1.3;
      if (wisp) {
        position += (position - lobe.center) * stream.uniform(0.05, 0.35);
        sigma *= stream.uniform(0.9, 1.5);
        density = stream.uniform(0.06, 0.2);
      }
      double sigmaY = sigma * recipe.flattening;
      if (position.y - 1.6 * sigmaY < floorMeters) {
        sigmaY = std::min(sigmaY, 0.55 * sigma);
        position.y = std::max(position.y, floorMeters + 1.6 * sigmaY * stream.uniform(0.9, 1.3));
      }
      // Ragged edges: where the noise is low the cloud has dried out.
      const double dryness = base::fractalNoise(position * noiseScale * 1.7, 3, 29);
      density *= std::clamp(1.0 + recipe.raggedness * (1.6 * dryness - 0.15), 0.15, 1.5);
      Puff puff;
      puff.center = position;
      puff.sigma = glm::vec3(sigma, sigmaY, sigma);
      // Every puff hides alike (the same optical depth through it), so that small ones at the surface keep it
      // crisp.
      puff.extinctionPerMeter = static_cast<float>(density / sigmaY);
      puff.section = lobe.section;
      puffs.push_back(puff);
    }
  }
}

glm::quat turnedAlong(const glm::dvec3& direction) {
  const double yaw = std::atan2(-direction.z, direction.x);
  const double pitch = std::atan2(direction.y, std::hypot(direction.x, direction.z));
  return glm::angleAxis(static_cast<float>(yaw), glm::vec3(0, 1, 0)) *
         glm::angleAxis(static_cast<float>(pitch), glm::vec3(0, 0, 1));
}

void addPrecipitation(std::vector<Puff>& puffs, const Recipe& recipe, const glm::dvec3& center, double radius,
                      double length, int count, base::RandomStream& stream) {
  constexpr double kLean = 0.35;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * stream.uniform(), r = radius * std::sqrt(stream.uniform());
    const glm::dvec3 foot(center.x + r * std::cos(angle), 0, center.z + r * std::sin(angle));
    // Curtains: denser where the noise says so, in long streaks that trail behind the cloud and thin towards
    // the ground.
    const double curtain = base::fractalNoise(foot * (2.2 / radius), 3, 41);
    const double down = stream.uniform(0.08, 1.0);
    Puff puff;
    puff.center = glm::dvec3(foot.x - kLean * length * down, center.y - length * down, foot.z);
    puff.sigma = glm::vec3(radius * 0.045, length * 0.24, radius * 0.045) *
                 static_cast<float>(stream.uniform(0.6, 1.3));
    puff.rotation = glm::angleAxis(static_cast<float>(-std::atan(kLean)), glm::vec3(0, 0, 1));
    puff.extinctionPerMeter = static_cast<float>(
        recipe.precipitation * std::clamp(0.45 + 1.8 * curtain, 0.02, 1.6) * (1.0 - 0.85 * down));
    puffs.push_back(puff);
  }
}

}  // namespace cloudgen::shape
