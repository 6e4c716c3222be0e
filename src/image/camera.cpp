// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "base/error.hpp"
#include "image/preview.hpp"

namespace cloudgen::image {
namespace {

/// The middle of the densest of 24 x 24 squares: centroid of its splats by opacity.
glm::dvec3 densestPlace(std::span<const Splat> splats, const glm::dvec3& lower, double across) {
  constexpr int kSquares = 24;
  std::vector<glm::dvec4> squares(kSquares * kSquares, glm::dvec4(0));
  for (const Splat& splat : splats) {
    const auto square = [&](double value) {
      return std::clamp(static_cast<int>(value / across * kSquares), 0, kSquares - 1);
    };
    const double weight = splat.opacity * std::max(splat.sigma.x, splat.sigma.z);
    squares[static_cast<size_t>(square(splat.center.z - lower.z) * kSquares +
                                square(splat.center.x - lower.x))] +=
        weight * glm::dvec4(glm::dvec3(splat.center), 1);
  }
  const auto best = std::max_element(squares.begin(), squares.end(),
                                     [](const auto& a, const auto& b) { return a.w < b.w; });
  return best->w > 0 ? glm::dvec3(*best) / best->w : glm::dvec3(lower);
}

}  // namespace

Camera cameraFor(std::string_view name, std::span<const Splat> splats, const Surroundings& surroundings,
                 int width, int height) {
  glm::dvec3 lower(1e300), upper(-1e300), mean(0);
  double weight = 0;
  for (const Splat& splat : splats) {
    lower = glm::min(lower, glm::dvec3(splat.center));
    upper = glm::max(upper, glm::dvec3(splat.center));
    mean += static_cast<double>(splat.opacity) * glm::dvec3(splat.center);
    weight += splat.opacity;
  }
  if (splats.empty()) lower = glm::dvec3(0), upper = glm::dvec3(10000), weight = 1;
  mean = splats.empty() ? 0.5 * (lower + upper) : mean / weight;
  Camera camera;
  camera.width = width;
  camera.height = height;
  const glm::dvec3 size = upper - lower;
  const double across = std::max(size.x, size.z), ground = surroundings.groundHeightMeters;
  const auto groundUnder = [&](const glm::dvec3& place) {
    const base::HeightField& terrain = surroundings.terrain;
    const bool relief = !terrain.empty() && terrain.covers(place.x, place.z);
    return relief ? std::max(ground, terrain.heightAt(place.x, place.z)) : ground;
  };
  if (name == "top") {
    const double aspect = static_cast<double>(width) / height;
    camera.target = {0.5 * (lower.x + upper.x), ground, 0.5 * (lower.z + upper.z)};
    camera.eye = camera.target + glm::dvec3(0, upper.y + 1.22 * std::max(size.z, size.x / aspect) + 500, 0);
  } else if (name == "ground") {
    // Far enough to see the tops, not so far that they sink into the haze; the sun over the shoulder.
    const glm::dvec3 sun(surroundings.sun.direction);
    glm::dvec3 away = glm::dvec3(sun.x * 0.4 - sun.z * 0.9, 0, sun.z * 0.4 + sun.x * 0.9);
    away /= std::max(1e-9, glm::length(away));
    const glm::dvec3 crowd = densestPlace(splats, lower, across);
    camera.eye = glm::dvec3(crowd.x, ground + 20, crowd.z) +
                 away * std::min(2.2 * crowd.y + 4000.0, 0.8 * across + 3000);
    camera.eye.y = groundUnder(camera.eye) + 20;
    camera.target = glm::dvec3(crowd.x, std::min(0.6 * upper.y, crowd.y * 1.2), crowd.z);
    camera.verticalFieldDegrees = 55;
  } else if (name == "horizon") {
    camera.eye = {mean.x, 1.15 * upper.y + 0.05 * across, upper.z + 0.12 * across};
    camera.target = {mean.x, 0.4 * mean.y, mean.z};
  } else {
    throw base::UsageError("--view " + std::string(name), "is not a known view",
                           "use top, ground, horizon or EYE:TARGET as lon,lat,height:lon,lat,height");
  }
  return camera;
}

}  // namespace cloudgen::image
