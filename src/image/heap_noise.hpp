// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace cloudgen::image {

/// Noise of round heaps with sharp creases between them, as on a cauliflower: 1 - d^2 of the distance d to
/// the nearest of one point a unit cube (Worley 1996, "A cellular texture basis function"), 0..1, repeated
/// every 16 units. Sampled from a table, because the volume renderer asks for it some hundred million times.
class HeapNoise {
 public:
  explicit HeapNoise(std::uint64_t seed);

  float at(const glm::vec3& point) const;
  /// Octaves added up from wavelength `longest` down to `shortest` (metres of `point`), each weighing 0.45 of
  /// the next longer one; an octave comes in and goes out gradually as the bounds pass it. 0..1, mean near
  /// 0.5.
  float octaves(const glm::vec3& point, float longest, float shortest) const;

 private:
  static constexpr int kPeriod = 16, kPerUnit = 8, kSide = kPeriod * kPerUnit;
  std::vector<std::uint16_t> table_;
};

/// The one table that all pictures share.
const HeapNoise& heapNoise();

}  // namespace cloudgen::image
