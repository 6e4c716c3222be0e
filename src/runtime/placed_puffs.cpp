// SPDX-License-Identifier: Apache-2.0
#include "runtime/placed_puffs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/selection.hpp"

namespace cloudgen::runtime {
namespace {

/// As schemas/runtime_pack.fbs packs it: the three smallest of x, y, z, w.
std::array<float, 4> rotationOf(std::uint32_t bits) {
  std::array<float, 4> parts{};
  const std::uint32_t largest = bits >> 30;
  float rest = 1;
  for (std::uint32_t i = 0, shift = 0; i < 4; ++i) {
    if (i == largest) continue;
    parts[i] = (2 * static_cast<float>(bits >> shift & 1023) / 1023 - 1) * 0.70710678f;
    rest -= parts[i] * parts[i];
    shift += 10;
  }
  parts[largest] = std::sqrt(std::max(rest, 0.0f));
  return parts;
}

/// After a turn about y.
std::array<float, 4> turned(const std::array<float, 4>& q, float cosine, float sine) {
  return {cosine * q[0] + sine * q[2], cosine * q[1] + sine * q[3], cosine * q[2] - sine * q[0],
          cosine * q[3] - sine * q[1]};
}

/// What is left of colours where other clouds take a part of the sun.
Vec3 dimmed(const Dimming& dimming, float sunlight) {
  const auto share = [&](float sun, float other) { return sun + other > 0 ? (sunlight * sun + other) / (sun + other) : 1.0f; };
  return {share(dimming.sun.x, dimming.other.x), share(dimming.sun.y, dimming.other.y),
          share(dimming.sun.z, dimming.other.z)};
}

}  // namespace

std::vector<PlacedPuff> placedPuffs(const Runtime& runtime, double seconds) {
  const PackView& pack = runtime.pack();
  const Lighting& lighting = runtime.lighting();
  Timeline timeline(pack);
  timeline.setTime(seconds);
  std::vector<PlacedPuff> out;
  for (const pack::Instance& cloud : timeline.moves() ? timeline.instances() : pack.instances()) {
    if (!(cloud.optical_depth_factor() > 0)) continue;
    const ArchetypeInfo& info = pack.archetypes()[cloud.archetype()];
    const Turn turn = turnOf(cloud.yaw_step());
    const float half = 3.1415927f * static_cast<float>(cloud.yaw_step()) / kYawSteps;
    const float sunlight = static_cast<float>(cloud.sunlight()) / 255;
    const Vec3 left = dimmed(lighting.dimming(cloud.archetype()), sunlight), sun = lighting.sunColor(cloud.archetype());
    const std::int64_t colors = lighting.firstColor(cloud.archetype(), cloud.yaw_step());
    for (std::uint32_t p = info.first[0]; p < info.first[0] + info.count[0]; ++p) {
      const pack::Puff& puff = pack.puffs()[p];
      const PuffColor& color = lighting.colors()[static_cast<std::size_t>(colors) + p - info.first[0]];
      const std::array<float, 4> rotation = turned(rotationOf(puff.rotation()), std::cos(half), std::sin(half));
      PlacedPuff placedPuff{placed(cloud, turn, pack.centers()[p]),
                            Vec3{floatOf(puff.sigma_x()), floatOf(puff.sigma_y()), floatOf(puff.sigma_z())} * cloud.scale(),
                            {rotation[0], rotation[1], rotation[2], rotation[3]},
                            floatOf(puff.optical_depth()) * cloud.optical_depth_factor(),
                            {},
                            sun * (sunlight * kMostForward * static_cast<float>(color.forward) / 255)};
      // The share is of light: encoded values take its root of about 2.2.
      const auto encoded = [](std::uint8_t value, float share) { return static_cast<float>(value) / 255 * std::pow(share, 1 / 2.2f); };
      placedPuff.color = {encoded(color.red, left.x), encoded(color.green, left.y), encoded(color.blue, left.z)};
      out.push_back(placedPuff);
    }
  }
  return out;
}

}  // namespace cloudgen::runtime
