// SPDX-License-Identifier: Apache-2.0
#include "image/backdrop.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/noise.hpp"
#include "image/sun_glare.hpp"
#include "light/relief.hpp"

namespace cloudgen::image {
namespace {

constexpr double kHazeHeightMeters = 2200, kHazeLengthMeters = 42000;

}  // namespace

Backdrop::Backdrop(std::span<const Splat> splats, const Surroundings& surroundings, const glm::dvec3& eye)
    : surroundings_(surroundings),
      atmosphere_(surroundings.sun, surroundings.sky, eye.y - surroundings.groundHeightMeters) {
  if (!surroundings.terrain.empty()) summit_ = surroundings.terrain.highest() + 1.0;
  if (splats.empty()) return;
  // The shadow falls along the sun; low suns are taken at 8 degrees so that it stays on the map.
  glm::dvec3 sun(surroundings.sun.direction);
  sun.y = std::max(sun.y, 0.14);
  const auto footOf = [&](const Splat& splat) {
    const double fall = (splat.center.y - surroundings.groundHeightMeters) / sun.y;
    return glm::dvec2(splat.center.x - sun.x * fall, splat.center.z - sun.z * fall);
  };
  constexpr double kShadowReach = 3.0;  // deviations: nothing is seen to be cut off
  glm::dvec2 lower(1e300), upper(-1e300);
  for (const Splat& splat : splats) {
    const double reach = kShadowReach * std::max(splat.sigma.x, splat.sigma.z);
    lower = glm::min(lower, footOf(splat) - reach);
    upper = glm::max(upper, footOf(splat) + reach);
  }
  side_ = 1024;
  cell_ = (std::max(upper.x - lower.x, upper.y - lower.y) + 1000) / (side_ - 8);
  originX_ = lower.x - 4 * cell_;
  originZ_ = lower.y - 4 * cell_;
  shadowDepth_.assign(static_cast<size_t>(side_) * side_, 0.0f);
  for (const Splat& splat : splats) {
    const glm::dvec2 foot = footOf(splat);
    const double radius = std::max<double>(std::max(splat.sigma.x, splat.sigma.z), 0.6 * cell_);
    const double thinned = std::min(1.0, std::pow(std::max(splat.sigma.x, splat.sigma.z) / radius, 2.0));
    const float depth = static_cast<float>(-std::log(1.0 - std::min(0.995f, splat.opacity)) * thinned);
    const auto cellOf = [&](double value, double origin) {
      return static_cast<int>((value - origin) / cell_);
    };
    for (int z = std::max(0, cellOf(foot.y - kShadowReach * radius, originZ_));
         z <= std::min(side_ - 1, cellOf(foot.y + kShadowReach * radius, originZ_)); ++z)
      for (int x = std::max(0, cellOf(foot.x - kShadowReach * radius, originX_));
           x <= std::min(side_ - 1, cellOf(foot.x + kShadowReach * radius, originX_)); ++x) {
        const double dx = originX_ + (x + 0.5) * cell_ - foot.x, dz = originZ_ + (z + 0.5) * cell_ - foot.y;
        shadowDepth_[static_cast<size_t>(z) * side_ + x] +=
            depth * static_cast<float>(std::exp(-0.5 * (dx * dx + dz * dz) / (radius * radius)));
      }
  }
}

float Backdrop::shadowAt(double x, double z) const {
  if (side_ == 0) return 0;
  const double u = (x - originX_) / cell_ - 0.5, v = (z - originZ_) / cell_ - 0.5;
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  if (i < 0 || j < 0 || i + 1 >= side_ || j + 1 >= side_) return 0;
  const float fu = static_cast<float>(u - i), fv = static_cast<float>(v - j);
  const float* row = shadowDepth_.data() + static_cast<size_t>(j) * side_ + i;
  return glm::mix(glm::mix(row[0], row[1], fu), glm::mix(row[side_], row[side_ + 1], fu), fv);
}

Haze Backdrop::hazeAlong(const glm::dvec3& eye, const glm::dvec3& direction) const {
  return {atmosphere_.sky(
              glm::normalize(glm::dvec3(direction.x, std::max(0.0, 0.15 * direction.y), direction.z))),
          std::exp(-std::max(0.0, eye.y) / kHazeHeightMeters) / kHazeLengthMeters, kHazeHeightMeters};
}

glm::vec3 Backdrop::sunlightThrough(const glm::dvec3& direction, float water, float ice) const {
  if (surroundings_.sun.elevationDegrees < -0.5) return glm::vec3(0);
  return atmosphere_.sunlight() *
         glareAndHalo(glm::dot(direction, glm::dvec3(surroundings_.sun.direction)), water, ice);
}

double Backdrop::distanceToTerrain(const glm::dvec3& eye, const glm::dvec3& direction) const {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const base::HeightField& terrain = surroundings_.terrain;
  if (terrain.empty()) return kNowhere;
  // The part of the ray over the lattice and below its summit.
  const glm::dvec3 lower(terrain.origin.x, surroundings_.groundHeightMeters, terrain.origin.y);
  const glm::dvec3 upper(terrain.origin.x + (terrain.columns - 1) * terrain.step.x, summit_,
                         terrain.origin.y + (terrain.rows - 1) * terrain.step.y);
  double start = 0, end = kNowhere;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-12) {
      if (eye[axis] < lower[axis] || eye[axis] > upper[axis]) return kNowhere;
      continue;
    }
    const double a = (lower[axis] - eye[axis]) / direction[axis],
                 b = (upper[axis] - eye[axis]) / direction[axis];
    start = std::max(start, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(start < end)) return kNowhere;
  const auto clearance = [&](double distance) {
    const glm::dvec3 point = eye + direction * distance;
    return point.y - terrain.heightAt(point.x, point.z);
  };
  const int steps = std::clamp(
      static_cast<int>((end - start) / (0.5 * std::min(terrain.step.x, terrain.step.y))) + 2, 8, 400);
  double above = start;
  for (int i = 1; i <= steps; ++i) {
    const double next = start + (end - start) * i / steps;
    if (clearance(next) > 0) {
      above = next;
      continue;
    }
    double below = next;
    for (int halving = 0; halving < 24; ++halving) {
      const double middle = 0.5 * (above + below);
      (clearance(middle) > 0 ? above : below) = middle;
    }
    return below;
  }
  return kNowhere;
}

/// Linear colour of the ground at a point that is seen from a distance, in the clouds' shadow.
glm::vec3 Backdrop::groundColor(const glm::dvec3& point, double distance) const {
  const double coarse = base::fractalNoise({point.x / 9000.0, 0.5, point.z / 9000.0}, 5, 101);
  const double fine =
      distance < 40000 ? base::fractalNoise({point.x / 420.0, 0.5, point.z / 420.0}, 3, 103) : 0.0;
  // Patches of the ground fade where a pixel would hold many of them.
  const double seen = 1.0 / (1.0 + std::pow(distance / 150000.0, 2.0));
  const base::HeightField& terrain = surroundings_.terrain;
  glm::vec3 ground = surroundings_.sky.ground;
  if (!terrain.empty() && terrain.covers(point.x, point.z)) {
    // The relief comes in gradually from the lattice's border, so that no line is seen there.
    const double width = (terrain.columns - 1) * terrain.step.x, depth = (terrain.rows - 1) * terrain.step.y;
    const double x = (point.x - terrain.origin.x) / width, z = (point.z - terrain.origin.y) / depth;
    const double inside = std::min({x, 1 - x, z, 1 - z});
    ground = glm::mix(ground,
                      light::reliefColorAt(terrain, point.x, point.z, surroundings_.sun, surroundings_.sky),
                      static_cast<float>(base::smoothStep(0.0, 0.08, inside)));
  }
  ground *= static_cast<float>(1.0 + 0.45 * seen * coarse + 0.2 * fine);
  ground = glm::mix(ground, glm::vec3(1.2f, 1.05f, 0.85f) * ground,
                    static_cast<float>(seen * base::smoothStep(-0.1, 0.5, coarse)));
  // The shadow was thrown on the flat ground: higher ground meets it earlier along the sun.
  const double up =
      (point.y - surroundings_.groundHeightMeters) / std::max(0.14f, surroundings_.sun.direction.y);
  const float vertical =
      shadowAt(point.x - surroundings_.sun.direction.x * up, point.z - surroundings_.sun.direction.z * up);
  const float slant = vertical / std::max(0.14f, surroundings_.sun.direction.y);
  return 1.1f * ground * light::groundDimming(slant, surroundings_.sun, surroundings_.sky);
}

glm::vec3 Backdrop::radianceAlong(const glm::dvec3& eye, const glm::dvec3& direction) const {
  double distance = distanceToTerrain(eye, direction);
  if (!std::isfinite(distance)) {
    if (direction.y > -1e-4) return atmosphere_.sky(direction);
    distance = (eye.y - surroundings_.groundHeightMeters) / -direction.y;
  }
  const Haze haze = hazeAlong(eye, direction);
  return glm::mix(haze.color, groundColor(eye + direction * distance, distance),
                  clarityThrough(haze, direction.y, static_cast<float>(distance)));
}

}  // namespace cloudgen::image
