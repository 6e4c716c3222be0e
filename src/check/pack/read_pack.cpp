// SPDX-License-Identifier: Apache-2.0
#include "check/pack/read_pack.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace cloudgen::check {
namespace {

constexpr std::size_t kLeastBytes = 16;
constexpr int kDepthLimit = 16;
constexpr std::uint32_t kTableLimit = 4'000'000;

}  // namespace

const pack::RuntimePack* packIn(std::string_view bytes, std::string& problem) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  problem.clear();
  if (bytes.size() < kLeastBytes || !pack::RuntimePackBufferHasIdentifier(data)) {
    problem = "has no \"CGPK\" in its bytes 4 to 7";
  } else if (bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE) {
    problem = "is over 2 GiB";
  } else {
    flatbuffers::Verifier verifier(data, bytes.size(), kDepthLimit, kTableLimit);
    if (!pack::VerifyRuntimePackBuffer(verifier)) problem = "is cut short, or an offset leads out of it";
  }
  if (!problem.empty()) return nullptr;
  const pack::RuntimePack* root = pack::GetRuntimePack(data);
  if (root->version() < 1 || root->version() > kPackVersion) {
    problem = fmt::format("is of version {}; known are 1 to {}", root->version(), kPackVersion);
    return nullptr;
  }
  return root;
}

float floatOf(std::uint16_t half) { return glm::unpackHalf1x16(half); }

PackPuff unpacked(const pack::Puff& puff, const glm::vec3& lower, const glm::vec3& upper) {
  const glm::vec3 at(puff.center_x(), puff.center_y(), puff.center_z());
  PackPuff out{glm::mix(lower, upper, at / 65535.0f),
               {floatOf(puff.sigma_x()), floatOf(puff.sigma_y()), floatOf(puff.sigma_z())}};
  std::array<float, 4> parts{};
  const std::uint32_t largest = puff.rotation() >> 30;
  float rest = 1;
  for (std::uint32_t i = 0, shift = 0; i < 4; ++i) {
    if (i == largest) continue;
    const float share = static_cast<float>(puff.rotation() >> shift & 1023) / 1023;
    parts[i] = (2 * share - 1) / std::numbers::sqrt2_v<float>;
    rest -= parts[i] * parts[i];
    shift += 10;
  }
  parts[largest] = std::sqrt(std::max(rest, 0.0f));
  out.rotation = glm::normalize(glm::quat(parts[3], parts[0], parts[1], parts[2]));
  out.opticalDepth = floatOf(puff.optical_depth());
  return out;
}

}  // namespace cloudgen::check
