// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace cloudgen::check {

/// The newest version of the format that is known here.
inline constexpr std::uint32_t kPackVersion = 1;

/// The root of a runtime pack (schemas/runtime_pack.fbs), safe to walk: no offset leads out of `bytes`, which
/// must start at a multiple of 16 bytes and outlive it. Null, and why in `problem`, where they are none.
const pack::RuntimePack* packIn(std::string_view bytes, std::string& problem);

/// Half floats, bit by bit.
float floatOf(std::uint16_t half);

/// A puff in its archetype's axes, metres.
struct PackPuff {
  glm::vec3 center{0}, sigma{1};
  glm::quat rotation{1, 0, 0, 0};
  float opticalDepth = 0;  ///< through the centre, along the shortest axis
};

/// `lower` and `upper` are the box of the archetype's centres.
PackPuff unpacked(const pack::Puff& puff, const glm::vec3& lower, const glm::vec3& upper);

inline glm::vec3 vec3(const pack::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace cloudgen::check
