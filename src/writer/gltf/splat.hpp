// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "light/puff_light.hpp"
#include "light/sky.hpp"
#include "shape/puff.hpp"

namespace cloudgen::writer::gltf {

/// Below this a splat is not seen: 8-bit viewers round it to one step or none.
inline constexpr float kLeastOpacity = 0.004f;
/// What is denser is opaque to the eye, and its opacity, a float just below 1, says no more how dense it is.
inline constexpr float kOpaqueOpticalDepth = 8;

/// A puff as a Gaussian splat.
struct Splat {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opacity = 0;
  float opticalDepth = 0;   ///< through the centre, along the shortest axis
  glm::vec3 color{0};       ///< sRGB-encoded, 0..1: what degree 0 stands for
  glm::vec3 towardsSun{0};  ///< sRGB-encoded: what degree 1 adds at full when one looks straight at the sun
};

/// 1 - exp(-optical depth) of a puff along its shortest axis.
float splatOpacity(const shape::Puff& placedPuff);

/// The splat of a puff that is shape::widenedAcross and lit.
Splat splatOf(const shape::Puff& widenedPuff, const light::PuffLight& light, const light::Sun& sun);

/// Factors of the coefficients of degrees 1 (three) and 2 (five), in the order and with the signs of
/// KHR_gaussian_splatting, for what Splat::towardsSun tells: half of max(0, mu) in degree 1 and 5/16 of it in
/// degree 2 (least squares over the sphere), mu the cosine between the look and `direction`.
std::array<float, 8> harmonicsTowards(glm::vec3 direction);

/// The constant of degree 0: colour = this * coefficient + 0.5.
inline constexpr float kHarmonic0 = 0.2820947917738781f;

/// The place on the Morton curve (three interleaved coordinates of 16 bits; Morton 1966), so many metres a
/// step from the lower corner.
std::uint64_t mortonOf(glm::vec3 place, glm::vec3 lower, float metersPerStep);

}  // namespace cloudgen::writer::gltf
