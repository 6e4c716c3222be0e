// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/spz.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "base/gzip.hpp"

namespace cloudgen::writer::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x5053474e, kVersion = 2;
constexpr int kMostFractionalBits = 23;
constexpr double kMostFixed = (1 << 23) - 1;

template <class Unsigned>
void append(std::string& out, Unsigned value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i & 0xff);
}

/// The whole number nearest to a value, in a byte.
std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(glm::clamp(value, 0.0f, 255.0f)));
}

std::uint8_t scaleByte(float sigma, double metersPerUnit) {
  return toByte(16 * (std::log(sigma / static_cast<float>(metersPerUnit)) + 10));
}

float sigmaOf(std::uint8_t byte, double metersPerUnit) {
  return static_cast<float>(metersPerUnit) * std::exp(static_cast<float>(byte) / 16 - 10);
}

/// The area that a splat's optical depth is spread over, but for a factor.
float areaOf(const glm::vec3& sigma) {
  return sigma.x * sigma.y * sigma.z / std::min({sigma.x, sigma.y, sigma.z});
}

int fractionalBits(std::span<const Splat> splats, double metersPerUnit) {
  double reach = 1;
  for (const Splat& splat : splats)
    for (int axis = 0; axis < 3; ++axis)
      reach = std::max(reach, std::abs(static_cast<double>(splat.center[axis])));
  return std::clamp(static_cast<int>(std::floor(std::log2(kMostFixed * metersPerUnit / reach))), 0,
                    kMostFractionalBits);
}

/// Rounds opacities; what one loses, times its area, the next one gets.
class OpacityBytes {
 public:
  std::uint8_t operator()(float opticalDepth, float area) {
    const float wanted = -255 * std::expm1(-opticalDepth);
    if (wanted > 254) return toByte(wanted);
    const std::uint8_t byte = std::max<std::uint8_t>(1, toByte(wanted + glm::clamp(owed_ / area, -1.0f, 1.0f)));
    owed_ = glm::clamp(owed_ + (wanted - static_cast<float>(byte)) * area, -area, area);
    return byte;
  }

 private:
  float owed_ = 0;
};

}  // namespace

std::string packedSplats(std::span<const Splat> splats, glm::vec3 sunDirection, double metersPerUnit,
                         int degree) {
  const int bits = fractionalBits(splats, metersPerUnit);
  const double steps = std::ldexp(1 / metersPerUnit, bits);
  const auto all = harmonicsTowards(sunDirection);
  const auto towardsSun = std::span(all).first(static_cast<std::size_t>(degree * (degree + 2)));
  std::string out, opacities, colors, scales, rotations, harmonics;
  append(out, kMagic, 4);
  append(out, kVersion, 4);
  append(out, static_cast<std::uint32_t>(splats.size()), 4);
  for (const int byte : {degree, bits, 0, 0}) out += static_cast<char>(byte);
  OpacityBytes opacityByte;
  for (const Splat& splat : splats) {
    glm::vec3 sigma(0);
    for (int axis = 0; axis < 3; ++axis) {
      const double fixed = glm::clamp(std::round(splat.center[axis] * steps), -kMostFixed, kMostFixed);
      append(out, static_cast<std::uint32_t>(static_cast<std::int32_t>(fixed)), 3);
      const std::uint8_t scale = scaleByte(splat.sigma[axis], metersPerUnit);
      scales += static_cast<char>(scale);
      sigma[axis] = sigmaOf(scale, metersPerUnit);
      colors += static_cast<char>(toByte(255 * ((splat.color[axis] - 0.5f) / kHarmonic0 * 0.15f + 0.5f)));
    }
    const float area = areaOf(sigma);
    opacities += static_cast<char>(opacityByte(splat.opticalDepth * areaOf(splat.sigma) / area, area));
    const glm::quat turn = splat.rotation.w < 0 ? -splat.rotation : splat.rotation;
    for (const float part : {turn.x, turn.y, turn.z}) rotations += static_cast<char>(toByte(127.5f * (part + 1)));
    for (const float share : towardsSun)
      for (int channel = 0; channel < 3; ++channel)
        harmonics += static_cast<char>(toByte(128 * splat.towardsSun[channel] * share + 128));
  }
  return base::gzipped(out + opacities + colors + scales + rotations + harmonics);
}

}  // namespace cloudgen::writer::gltf
