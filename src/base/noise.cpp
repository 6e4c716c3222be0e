// SPDX-License-Identifier: Apache-2.0
#include "base/noise.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::base {
namespace {

/// SplitMix64's finaliser (Steele et al. 2014) over the lattice address, one coordinate after the other: the
/// corners of a cell share the first two.
std::uint64_t hashedX(std::int64_t x, std::uint64_t seed) {
  const std::uint64_t h = seed + 0x9e3779b97f4a7c15u * (static_cast<std::uint64_t>(x) + 1);
  return (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
}
std::uint64_t hashedY(std::uint64_t hashOfX, std::int64_t y) {
  const std::uint64_t h = hashOfX + 0xd1b54a32d192ed03u * (static_cast<std::uint64_t>(y) + 1);
  return (h ^ (h >> 27)) * 0x94d049bb133111ebu;
}
std::uint64_t hashedZ(std::uint64_t hashOfXy, std::int64_t z) {
  std::uint64_t h = hashOfXy + 0x8cb92ba72f3d8dd7u * (static_cast<std::uint64_t>(z) + 1);
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

/// The twelve edge directions of a cube, four of them twice, as Perlin 2002 chose them. A table, for a choice by
/// chance is one that processors cannot foresee.
constexpr double kSlopes[16][3]{{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1},
                                {1, 1, 0},  {0, -1, 1},  {-1, 1, 0}, {0, -1, -1}};

double slope(std::uint64_t hash, double x, double y, double z) {
  const double* const along = kSlopes[hash & 15];
  return along[0] * x + along[1] * y + along[2] * z;
}

std::int64_t floorOf(double value) {
  const auto towardsZero = static_cast<std::int64_t>(value);
  return towardsZero - (value < static_cast<double>(towardsZero));
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

double mix(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

double gradientNoise(const glm::dvec3& point, std::uint64_t seed) {
  const std::int64_t x = floorOf(point.x), y = floorOf(point.y), z = floorOf(point.z);
  const double dx = point.x - static_cast<double>(x), dy = point.y - static_cast<double>(y),
               dz = point.z - static_cast<double>(z);
  const double u = fade(dx), v = fade(dy), w = fade(dz);
  std::uint64_t hashes[2][2];
  for (int i = 0; i < 2; ++i) {
    const std::uint64_t hash = hashedX(x + i, seed);
    for (int j = 0; j < 2; ++j) hashes[i][j] = hashedY(hash, y + j);
  }
  const auto corner = [&](int i, int j, int k) {
    return slope(hashedZ(hashes[i][j], z + k), dx - i, dy - j, dz - k);
  };
  return mix(mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v),
             mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v), w);
}

double fractalNoise(const glm::dvec3& point, int octaves, std::uint64_t seed) {
  double sum = 0, amplitude = 0.5, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * gradientNoise(point * frequency, seed + static_cast<std::uint64_t>(octave));
    amplitude *= 0.5;
    frequency *= 2;
  }
  return sum;
}

double billowNoise(const glm::dvec3& point, int octaves, std::uint64_t seed) {
  double sum = 0, total = 0, amplitude = 0.5, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude *
           (1.0 - std::abs(gradientNoise(point * frequency, seed + static_cast<std::uint64_t>(octave))));
    total += amplitude;
    amplitude *= 0.5;
    frequency *= 2;
  }
  return sum / total;
}

double smoothStep(double edge0, double edge1, double value) {
  const double t = std::clamp((value - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace cloudgen::base
