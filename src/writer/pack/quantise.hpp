// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <array>
#include <span>

#include "light/response.hpp"
#include "shape/puff.hpp"

namespace cloudgen::writer::packed {

/// A quaternion in 32 bits as schemas/runtime_pack.fbs says; turns by less than 0.2 degrees.
std::uint32_t smallestThree(glm::quat rotation);

/// A puff within the box of its archetype's centres.
pack::Puff quantised(const shape::Puff& puff, const shape::Bounds& centers, float level);

/// What a byte of 127 stands for, one a coefficient.
struct ResponseScale {
  std::array<float, light::kHarmonics> sun{}, forward{};
  float weight = 0;  ///< what 255 stands for
};

/// The largest of each among responses; 0 where all are.
ResponseScale scaleOf(std::span<const light::PuffResponse> responses);

pack::Response quantised(const light::PuffResponse& response, const ResponseScale& scale);

inline pack::Vec3 vec3(const glm::vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace cloudgen::writer::packed
