// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace cloudgen::base {

/// Gradient noise (Perlin 2002) on an unbounded lattice whose gradients are hashed from the seed; about
/// -1..1, zero at lattice points, continuous second derivatives.
double gradientNoise(const glm::dvec3& point, std::uint64_t seed);

/// Fractal sum of gradient noise: each octave at twice the frequency and half the amplitude; about -1..1.
double fractalNoise(const glm::dvec3& point, int octaves, std::uint64_t seed);

/// Billows: 1 - |noise| summed over octaves, 0..1; sharp valleys between round heaps as on a cauliflower.
double billowNoise(const glm::dvec3& point, int octaves, std::uint64_t seed);

/// 3t^2 - 2t^3 between two edges, clamped.
double smoothStep(double edge0, double edge1, double value);

}  // namespace cloudgen::base
