// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/patches.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::runtime::gles {
namespace {

/// A number of 0 to 1 that belongs to a place of the lattice.
float chance(std::uint32_t x, std::uint32_t y, std::uint32_t octave) {
  std::uint32_t bits = x * 0x8da6b343u ^ y * 0xd8163841u ^ octave * 0xcb1ab31fu;
  bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
  bits = (bits ^ bits >> 12) * 0x297a2d39u;
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

float valueNoise(float x, float y, std::uint32_t period, std::uint32_t octave) {
  const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
  const auto eased = [](float t) { return t * t * (3 - 2 * t); };
  const float u = eased(x - static_cast<float>(i)), v = eased(y - static_cast<float>(j));
  const auto at = [&](std::uint32_t a, std::uint32_t b) { return chance(a % period, b % period, octave); };
  const float low = at(i, j) + u * (at(i + 1, j) - at(i, j)), high = at(i, j + 1) + u * (at(i + 1, j + 1) - at(i, j + 1));
  return low + v * (high - low);
}

}  // namespace

std::vector<std::uint8_t> groundPatches() {
  std::vector<std::uint8_t> texels;
  texels.reserve(kPatchesAcross * kPatchesAcross);
  for (int y = 0; y < kPatchesAcross; ++y)
    for (int x = 0; x < kPatchesAcross; ++x) {
      float sum = 0, weight = 1, period = 10;
      for (std::uint32_t octave = 0; octave < 5; ++octave, weight *= 0.5f, period *= 2)
        sum += weight * (valueNoise(static_cast<float>(x) * period / kPatchesAcross, static_cast<float>(y) * period / kPatchesAcross,
                                    static_cast<std::uint32_t>(period), octave) - 0.5f);
      texels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(0.5f + 0.6f * sum, 0.0f, 1.0f))));
    }
  return texels;
}

}  // namespace cloudgen::runtime::gles
