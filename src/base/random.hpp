// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace cloudgen::base {

/// What a random number decides. The values are part of the address: append, never renumber.
enum class Purpose : std::uint64_t {
  CloudPlace = 1,
  CloudSize = 2,
  CloudYaw = 3,
  CloudVariant = 4,
  CloudHeight = 5,
  SectionPlace = 10,
  BillboardPlace = 11,
  BillboardSize = 12,
  BillboardSprite = 13,
  ShapeDetail = 14,
  GrammarRule = 15,
  GrammarTurn = 16,
  SpriteNoise = 20,
  FieldNoise = 21,
  Test = 99
};

/// Uniform random numbers that are a pure function of (seed, cell, purpose, item) and the count of draws:
/// Philox4x64-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"). Independent of
/// threads, tiling and machine.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t cell, Purpose purpose, std::uint64_t item = 0);

  std::uint64_t bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Box-Muller).
  double gaussian();
  /// Uniform on the unit sphere.
  glm::dvec3 direction();
  /// Uniform in 0 .. count-1; count > 0.
  int index(int count);

 private:
  std::uint64_t seed_, cell_, purpose_, item_, block_ = 0;
  std::array<std::uint64_t, 4> values_{};
  int used_ = 4;
};

}  // namespace cloudgen::base
