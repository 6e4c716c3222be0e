// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/splat.hpp"

#include <array>
#include <glm/common.hpp>
#include <numbers>


namespace cloudgen::writer::gltf {
namespace {

/// Puts two zero bits between the 16 bits of a coordinate.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ff0000ff;
  bits = (bits | bits << 8) & 0x00f00f00f00f;
  bits = (bits | bits << 4) & 0x0c30c30c30c3;
  return (bits | bits << 2) & 0x249249249249;
}

}  // namespace

float splatOpacity(const shape::Puff& placedPuff) {
  return -std::expm1(-shape::frontalOpticalDepth(placedPuff));
}

Splat splatOf(const shape::Puff& puff, const light::PuffLight& light, const light::Sun& sun) {
  const light::EncodedLight shown = light::encoded(light, sun.color);
  return {puff.center,         puff.sigma, glm::normalize(puff.rotation), splatOpacity(puff),
          shape::frontalOpticalDepth(puff), shown.mean, shown.towardsSun};
}

std::array<float, 8> harmonicsTowards(glm::vec3 direction) {
  constexpr float kHarmonic1 = 0.4886025119029199f;
  // The Legendre polynomial of mu is 4 pi / 5 times the sum of products of harmonics; degree 1 has half of what
  // is added, degree 2 5/16.
  constexpr float kHalfPi = std::numbers::pi_v<float> / 2;
  const auto [x, y, z] = std::array{direction.x, direction.y, direction.z};
  return {-y / kHarmonic1,
          z / kHarmonic1,
          -x / kHarmonic1,
          kHalfPi * 1.0925484305920792f * x * y,
          kHalfPi * -1.0925484305920792f * y * z,
          kHalfPi * 0.31539156525252005f * (2 * z * z - x * x - y * y),
          kHalfPi * -1.0925484305920792f * x * z,
          kHalfPi * 0.5462742152960396f * (x * x - y * y)};
}

std::uint64_t mortonOf(glm::vec3 place, glm::vec3 lower, float metersPerStep) {
  const glm::vec3 steps = glm::clamp((place - lower) / metersPerStep, 0.0f, 65535.0f);
  return spread(static_cast<std::uint64_t>(steps.x)) | spread(static_cast<std::uint64_t>(steps.y)) << 1 |
         spread(static_cast<std::uint64_t>(steps.z)) << 2;
}

}  // namespace cloudgen::writer::gltf
