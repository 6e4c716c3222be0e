// SPDX-License-Identifier: Apache-2.0
// The light of the grid against photons traced one by one.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "base/random.hpp"
#include "light/octaves.hpp"
#include "light/sweep.hpp"
#include "light/transfer.hpp"
#include "support/ball.hpp"
#include "support/path_tracer.hpp"

namespace cloudgen::light {
namespace {

using test::ball;

constexpr float kAsymmetry = 0.85f;

/// Fills a body with small even puffs.
template <class Inside>
std::vector<shape::Puff> filled(const glm::vec3& half, float spacing, float extinction, Inside&& inside) {
  std::vector<shape::Puff> puffs;
  for (float z = -half.z; z <= half.z; z += spacing)
    for (float y = -half.y; y <= half.y; y += spacing)
      for (float x = -half.x; x <= half.x; x += spacing)
        if (inside(glm::vec3(x, y, z))) puffs.push_back(ball({x, y, z}, 0.55f * spacing, extinction));
  return puffs;
}

std::vector<shape::Puff> sphere(float extinction) {
  return filled(glm::vec3(500), 100, extinction, [](auto p) { return glm::dot(p, p) < 500 * 500; });
}

std::vector<shape::Puff> slab(float extinction) {
  return filled({1500, 200, 1500}, 100, extinction, [](auto) { return true; });
}

std::vector<shape::Puff> heap(float extinction) {
  base::RandomStream random(11, 4, base::Purpose::Test);
  std::vector<shape::Puff> puffs;
  for (int lobe = 0; lobe < 12; ++lobe) {
    const glm::vec3 middle(random.uniform(-500, 500), random.uniform(150, 650), random.uniform(-400, 400));
    const double radius = random.uniform(150, 260);
    for (int i = 0; i < 40; ++i) {
      const glm::vec3 place = middle + glm::vec3(radius * random.direction());
      if (place.y > 0) puffs.push_back(ball(place, 70, extinction));
    }
  }
  return puffs;
}

/// What a cloud hides of the plane across a direction, m2: the integral of its opacity.
double opaqueArea(const ExtinctionGrid& grid, const glm::vec3& view) {
  const glm::vec3 size = glm::vec3(grid.size()) * grid.cellMeters(), center = grid.lower() + 0.5f * size;
  const float radius = 0.5f * glm::length(size), step = radius / 30;
  const glm::vec3 u = test::deflected(view, 0, 0), v = glm::cross(view, u);
  double area = 0;
  for (float a = -radius; a < radius; a += step)
    for (float b = -radius; b < radius; b += step) {
      float depth = 0;
      for (float c = -radius; c < radius; c += 0.7f * grid.cellMeters())
        depth += grid.extinction(center + a * u + b * v + c * view);
      area += (1 - std::exp(-depth * 0.7f * grid.cellMeters())) * step * step;
    }
  return area;
}

/// Intensity of a cloud in a direction, m2/sr of a beam of irradiance 1: its opaque area times the mean
/// radiance of its puffs, each as far as it is seen.
double gridIntensity(const std::vector<shape::Puff>& puffs, const std::vector<SunAnswer>& answers,
                     const ExtinctionGrid& grid, const glm::vec3& view, const glm::vec3& sun) {
  DepthSweep sweep(grid);
  sweep.towards(view);
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    base::RandomStream random(5, i, base::Purpose::Test);
    double seen = 0;
    constexpr int kPoints = 12;
    for (int k = 0; k < kPoints; ++k) {
      const glm::vec3 offset(random.gaussian(), random.gaussian(), random.gaussian());
      if (glm::dot(offset, offset) > 6) continue;
      const glm::vec3 point = puffs[i].center + puffs[i].sigma * offset;
      seen += std::exp(-sweep.at(point)) * (grid.extinction(point) > 0);
    }
    sum += shape::extinctionArea(puffs[i]) * seen * answers[i].sun;
    weight += shape::extinctionArea(puffs[i]) * seen;
  }
  const ScatteredOnce once = answers.front().once;
  const double uneven = once.even + once.towards * (0.25 - 0.5 * glm::dot(view, sun));
  return uneven * opaqueArea(grid, view) * sum / weight / std::numbers::pi;
}

double tracedIntensity(const test::Traced& traced, const glm::vec3& view) {
  const float cosine = std::cos(25 * std::numbers::pi_v<float> / 180);
  double photons = 0;
  for (const test::Escape& escape : traced.escaped) photons += glm::dot(escape.direction, view) > cosine;
  return photons * traced.areaPerPhoton / (2 * std::numbers::pi * (1 - cosine));
}

/// Relative error, root of the mean square, over views within `widest` of the sun's direction: beyond, the
/// glare of light that was deflected once or twice is not what a puff's colour stands for.
double error(const std::vector<shape::Puff>& puffs, const glm::vec3& sun, int widestDegrees) {
  const ExtinctionGrid grid(puffs, 50);
  const auto answers = bakeSun(puffs, grid, kAsymmetry, sun);
  const test::Traced traced = test::tracePhotons(grid, sun, kAsymmetry, 20'000, 7);
  const glm::vec3 side = test::deflected(sun, 0, 0.4f), up = glm::cross(side, sun);
  double squares = 0;
  int views = 0;
  for (int angle = 20; angle <= widestDegrees; angle += 40)
    for (int turn = 0; turn < 4; ++turn) {
      const double a = angle * std::numbers::pi / 180, b = turn * std::numbers::pi / 2;
      const glm::vec3 view = static_cast<float>(std::cos(a)) * sun +
                             static_cast<float>(std::sin(a)) * (static_cast<float>(std::cos(b)) * side +
                                                                static_cast<float>(std::sin(b)) * up);
      const double off = gridIntensity(puffs, answers, grid, view, sun) / tracedIntensity(traced, view) - 1;
      squares += off * off;
      ++views;
    }
  return std::sqrt(squares / views);
}

TEST(Scattering, ASphereShinesAsTraced) {
  EXPECT_LT(error(sphere(0.02f), glm::normalize(glm::vec3(1, 2, 0.5f)), 100), 0.1);
}

TEST(Scattering, AHeapShinesAsTraced) {
  EXPECT_LT(error(heap(0.02f), glm::normalize(glm::vec3(1, 1, 0.5f)), 100), 0.1);
}

TEST(Scattering, ASlabShinesAsTraced) { EXPECT_LT(error(slab(0.015f), glm::vec3(0, 1, 0), 60), 0.1); }

/// Albedo and transmittance of a wide slab of optical depth `depth` under a sun overhead: answers of the
/// puffs of its top and bottom in the middle.
std::pair<float, float> slabUnderTheSun(float depth) {
  std::vector<shape::Puff> puffs;
  constexpr float kSpacing = 25, kLayers = 12, kReach = 20 * kSpacing;
  for (float y = 0; y < kLayers; ++y)
    for (float z = -kReach; z <= kReach; z += kSpacing)
      for (float x = -kReach; x <= kReach; x += kSpacing)
        puffs.push_back(ball({x, y * kSpacing, z}, 0.6f * kSpacing, 1));
  const float through = static_cast<float>(shape::extinctionArea(puffs[0])) * kLayers / (kSpacing * kSpacing);
  for (shape::Puff& puff : puffs) puff.extinctionPerMeter = depth / through;
  const ExtinctionGrid grid(puffs, 64);
  const auto answers = bakeSun(puffs, grid, kAsymmetry, {0, 1, 0});
  std::pair<float, float> found;
  for (std::size_t i = 0; i < puffs.size(); ++i) {
    if (puffs[i].center.x != 0 || puffs[i].center.z != 0) continue;
    if (puffs[i].center.y == 0) found.second = answers[i].sun;
    if (puffs[i].center.y == (kLayers - 1) * kSpacing) found.first = answers[i].sun;
  }
  return found;
}

// A thin slab is drawn as far as it is opaque: this times the light of its puffs is what it reflects.
TEST(Scattering, ASlabReflectsAsTwoStreamsDo) {
  for (const float depth : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 40.0f, 64.0f}) {
    const float reduced = (1 - kAsymmetry) * depth;
    const auto [top, bottom] = slabUnderTheSun(depth);
    const float albedo = top * (1 - std::exp(-depth));
    EXPECT_NEAR(albedo / (reduced / (2 + reduced)), 1, 0.05) << depth;
    EXPECT_LE(top, 1);
    // Of what thinner ones let through, most still comes as from the sun, which is not in a puff's colour.
    if (depth > 8) {
      EXPECT_NEAR(albedo + bottom, 1, 0.05) << depth;
    }
  }
}

TEST(Scattering, AThinSphereIsNotAsBrightAsAThickOne) {
  const glm::vec3 sun = glm::normalize(glm::vec3(1, 2, 0.5f)), aside = test::deflected(sun, 0, 0);
  const auto thin = sphere(0.001f);
  const ExtinctionGrid grid(thin, 40);
  const auto answers = bakeSun(thin, grid, kAsymmetry, sun);
  const test::Traced traced = test::tracePhotons(grid, sun, kAsymmetry, 200'000, 7);
  EXPECT_NEAR(gridIntensity(thin, answers, grid, aside, sun) / tracedIntensity(traced, aside), 1, 0.5);
  EXPECT_NEAR(gridIntensity(thin, answers, grid, sun, sun) / tracedIntensity(traced, sun), 1, 0.5);
}

// All octaves together, by hand: weights 2 exp(-2 s) ds over thinnings s, a geometric series of them.
TEST(Octaves, SumToTheTwoStreamSolution) {
  for (const float depth : {0.0f, 0.3f, 1.0f, 4.0f, 15.0f}) {
    double sum = 0, ratio = 0.9;
    for (double s = 40; s > 1e-6; s *= ratio)
      sum += 2 * std::exp(-2 * s) * s * -std::log(ratio) * std::exp(-s * depth);
    EXPECT_NEAR(transmitted(depth), sum, 1e-3) << depth;
    EXPECT_FLOAT_EQ(reflected(0, depth) + transmitted(depth), 1);
    EXPECT_LT(reflected(1, depth), reflected(0, depth) + 1e-6f);
  }
}

}  // namespace
}  // namespace cloudgen::light
