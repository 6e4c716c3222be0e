// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

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
  const size_t parents = lobes.size();
  for (size_t i = 0; i < parents; ++i) {
    if (lobes[i].level != level - 1) continue;
    for (int child = 0; child < children; ++child) {
      const Lobe parent = lobes[i];
      glm::dvec3 direction = stream.direction();
      if (direction.y < -0.15) direction.y = -direction.y;
      const double radius = parent.radius * ratio * stream.uniform(0.6, 1.25);
      const double reach = parent.radius * stream.uniform(0.72, 0.98);
      lobes.push_back({parent.center + direction * reach, radius, parent.section, level});
    }
  }
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
    const double size = std::min(recipe.billboardSize * lobe.radius * 1.25, 0.62 * spacing);
    for (int i = 0; i < share; ++i) {
      const bool surface = stream.uniform() < (lobe.level == finest ? 0.88 : 0.7);
      glm::dvec3 position{};
      for (int attempt = 0; attempt < 6; ++attempt) {
        glm::dvec3 direction = stream.direction();
        if (recipe.billboardPlacement.system == CoordinateSystem::HalfSpherical)
          direction.y = std::abs(direction.y);
        const double depth = surface ? stream.uniform(0.8, 1.0) : 0.8 * std::cbrt(stream.uniform());
        // Billows in the surface: round heaps between sharp creases.
        const glm::dvec3 onSurface = lobe.center + direction * lobe.radius;
        const double bulge = 0.88 + 0.75 * (base::billowNoise(onSurface * noiseScale * 2.1, 4, 17) - 0.70);
        position = lobe.center + direction * (lobe.radius * depth * bulge);
        if (!surface || !buried(position, lobes, lobe)) break;
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
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * stream.uniform(), r = radius * std::sqrt(stream.uniform());
    const glm::dvec3 foot(center.x + r * std::cos(angle), 0, center.z + r * std::sin(angle));
    // Curtains: denser where the noise says so, thinning towards the ground.
    const double curtain = base::fractalNoise(foot * (2.2 / radius), 3, 41);
    const double down = stream.uniform();
    Puff puff;
    const double lean = 0.35 * length * down;
    puff.center = glm::dvec3(foot.x - lean, center.y - length * down, foot.z);
    puff.sigma =
        glm::vec3(radius * 0.05, length * 0.16, radius * 0.05) * static_cast<float>(stream.uniform(0.7, 1.4));
    puff.rotation = glm::angleAxis(-0.33f, glm::vec3(0, 0, 1));
    puff.extinctionPerMeter = static_cast<float>(
        recipe.precipitation * std::clamp(0.45 + 1.6 * curtain, 0.02, 1.5) * (1.0 - 0.65 * down));
    puffs.push_back(puff);
  }
}

}  // namespace cloudgen::shape
