// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace cloudgen::writer::packed {
namespace {

constexpr float kMostHalf = 65504, kLeastHalf = 6.2e-5f;

std::uint16_t half(float value) { return glm::packHalf1x16(std::clamp(value, kLeastHalf, kMostHalf)); }

std::uint8_t unitByte(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

std::int8_t signedByte(float value, float scale) {
  return static_cast<std::int8_t>(scale > 0 ? std::lround(127 * std::clamp(value / scale, -1.0f, 1.0f)) : 0);
}

}  // namespace

std::uint32_t smallestThree(glm::quat rotation) {
  rotation = glm::normalize(rotation);
  const std::array<float, 4> parts{rotation.x, rotation.y, rotation.z, rotation.w};
  std::uint32_t largest = 0;
  for (std::uint32_t i = 1; i < 4; ++i)
    if (std::abs(parts[i]) > std::abs(parts[largest])) largest = i;
  const float sign = parts[largest] < 0 ? -1.0f : 1.0f;
  std::uint32_t bits = largest << 30, shift = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const float share = 0.5f + 0.5f * sign * parts[i] * std::numbers::sqrt2_v<float>;
    bits |= static_cast<std::uint32_t>(std::lround(1023 * std::clamp(share, 0.0f, 1.0f))) << shift;
    shift += 10;
  }
  return bits;
}

pack::Puff quantised(const shape::Puff& puff, const shape::Bounds& centers, float level) {
  const glm::vec3 extent = glm::max(centers.upper - centers.lower, glm::vec3(1e-6f));
  const glm::vec3 at = 65535.0f * glm::clamp((puff.center - centers.lower) / extent, 0.0f, 1.0f);
  const auto whole = [](float value) { return static_cast<std::uint16_t>(std::lround(value)); };
  return {whole(at.x),
          whole(at.y),
          whole(at.z),
          half(puff.sigma.x),
          half(puff.sigma.y),
          half(puff.sigma.z),
          smallestThree(puff.rotation),
          half(shape::frontalOpticalDepth(puff)),
          static_cast<std::uint8_t>(puff.sprite & 0xff),
          unitByte(level)};
}

ResponseScale scaleOf(std::span<const light::PuffResponse> responses) {
  ResponseScale scale;
  for (const light::PuffResponse& response : responses) {
    for (std::size_t i = 0; i < light::kHarmonics; ++i) {
      scale.sun[i] = std::max(scale.sun[i], std::abs(response.sun[i]));
      scale.forward[i] = std::max(scale.forward[i], std::abs(response.forward[i]));
    }
    scale.weight = std::max(scale.weight, response.weight);
  }
  return scale;
}

pack::Response quantised(const light::PuffResponse& response, const ResponseScale& scale) {
  std::array<std::int8_t, light::kHarmonics> s{}, f{};
  for (std::size_t i = 0; i < light::kHarmonics; ++i) {
    s[i] = signedByte(response.sun[i], scale.sun[i]);
    f[i] = signedByte(response.forward[i], scale.forward[i]);
  }
  return {s[0],  s[1],  s[2],  s[3],
          s[4],  s[5],  s[6],  s[7],
          s[8],  s[9],  s[10], s[11],
          s[12], s[13], s[14], s[15],
          f[0],  f[1],  f[2],  f[3],
          f[4],  f[5],  f[6],  f[7],
          f[8],  f[9],  f[10], f[11],
          f[12], f[13], f[14], f[15],
          unitByte(response.sky),
          unitByte(response.ground),
          unitByte(response.seen),
          unitByte(scale.weight > 0 ? response.weight / scale.weight : 0)};
}

}  // namespace cloudgen::writer::packed
