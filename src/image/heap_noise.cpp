// SPDX-License-Identifier: Apache-2.0
#include "image/heap_noise.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "base/thread.hpp"

namespace cloudgen::image {

HeapNoise::HeapNoise(std::uint64_t seed) {
  std::vector<glm::vec3> points(static_cast<size_t>(kPeriod) * kPeriod * kPeriod);
  for (size_t i = 0; i < points.size(); ++i) {
    base::RandomStream stream(seed, i, base::Purpose::SpriteNoise);
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = static_cast<float>(stream.uniform(0.05, 0.95));
  }
  const auto wrapped = [](int i) { return (i + kPeriod) % kPeriod; };
  table_.resize(static_cast<size_t>(kSide) * kSide * kSide);
  base::parallelFor(kSide, [&](size_t z) {
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const glm::vec3 place = glm::vec3(x, y, static_cast<float>(z)) / static_cast<float>(kPerUnit);
        const glm::ivec3 cube(place);
        float nearest = 4;
        for (int k = -1; k <= 1; ++k)
          for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
              const size_t index = (static_cast<size_t>(wrapped(cube.z + k)) * kPeriod +
                                    static_cast<size_t>(wrapped(cube.y + j))) *
                                       kPeriod +
                                   static_cast<size_t>(wrapped(cube.x + i));
              const glm::vec3 away = glm::vec3(cube + glm::ivec3(i, j, k)) + points[index] - place;
              nearest = std::min(nearest, glm::dot(away, away));
            }
        table_[(z * kSide + static_cast<size_t>(y)) * kSide + static_cast<size_t>(x)] =
            static_cast<std::uint16_t>(std::lround(65535 * std::clamp(1 - nearest, 0.0f, 1.0f)));
      }
  });
}

float HeapNoise::at(const glm::vec3& point) const {
  const glm::vec3 p = point * static_cast<float>(kPerUnit);
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const float u = p.x - fx, v = p.y - fy, w = p.z - fz;
  constexpr int kMask = kSide - 1;
  static_assert((kSide & kMask) == 0);
  const int x0 = static_cast<int>(fx) & kMask, x1 = (x0 + 1) & kMask;
  const int y0 = (static_cast<int>(fy) & kMask) * kSide, y1 = (y0 + kSide) & (kMask * kSide);
  constexpr int kLayer = kSide * kSide;
  const int z0 = (static_cast<int>(fz) & kMask) * kLayer, z1 = (z0 + kLayer) & (kMask * kLayer);
  const std::uint16_t* t = table_.data();
  const auto row = [&](int base) {
    const float a = t[base + x0];
    return a + u * (static_cast<float>(t[base + x1]) - a);
  };
  const float a = row(z0 + y0), b = row(z0 + y1), c = row(z1 + y0), d = row(z1 + y1);
  const float near = a + v * (b - a), far = c + v * (d - c);
  return (near + w * (far - near)) * (1.0f / 65535.0f);
}

float HeapNoise::octaves(const glm::vec3& point, float longest, float shortest) const {
  const float top = std::log2(longest), bottom = std::log2(std::max(shortest, longest / 64.0f));
  float sum = 0.02f * 0.68f, total = 0.02f, amplitude = 1;
  for (int k = static_cast<int>(std::floor(top)); static_cast<float>(k) > bottom - 1; --k) {
    const float share = std::min(1.0f, top - static_cast<float>(k)) *
                        std::clamp(static_cast<float>(k) - bottom + 1, 0.0f, 1.0f);
    if (share > 0) {
      const float scale = std::exp2(static_cast<float>(-k)), shift = 3.7f * static_cast<float>(k);
      sum += share * amplitude * at(point * scale + glm::vec3(shift, 1.618f * shift, 2.414f * shift));
      total += share * amplitude;
      amplitude *= 0.45f * share + (1 - share);
    }
  }
  return std::clamp(1.9f * (sum / total) - 0.8f, 0.0f, 1.0f);
}

const HeapNoise& heapNoise() {
  static const HeapNoise noise(7);
  return noise;
}

}  // namespace cloudgen::image
