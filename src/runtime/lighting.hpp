// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/pack_view.hpp"

namespace cloudgen::runtime {

/// Where the sun stands. Azimuth clockwise from north.
struct SunPlace {
  float azimuthDegrees = 180, elevationDegrees = 45;
};

/// Towards the sun.
Vec3 directionTo(const SunPlace& sun) noexcept;

/// The colour of a puff under the sun: display-encoded (sRGB), and what of the sun's colour it adds when one looks
/// towards the sun (255 is kMostForward).
struct PuffColor {
  std::uint8_t red = 255, green = 255, blue = 255, forward = 0;
};
inline constexpr float kMostForward = 1.0f;

/// Colours about the clouds, display-linear.
struct SkyColors {
  Vec3 zenith, horizon, ground, ambient, bounce;
};

/// A cloud that gets the share s of the sun has its colours times (s sun + other) / (sun + other).
struct Dimming {
  Vec3 sun, other;
};

/// The light of a pack under a sun that moves. An update is a dot product a puff of every archetype and heading that
/// stands in the sky; clouds that share both share the colours.
class Lighting {
 public:
  Lighting() = default;
  /// Room for the headings of the pack's clouds, or for all. The pack must stay where it is. Throws std::bad_alloc.
  Lighting(const PackView& pack, bool allHeadings);

  /// Nothing is allocated.
  void setSun(const SunPlace& sun) noexcept;

  /// Number of an archetype's colours under a heading among `colors`: that of puff p is at the number plus p less the
  /// first puff of the archetype. -1 where no cloud of the pack has that heading.
  std::int64_t firstColor(std::uint32_t archetype, std::uint32_t yawStep) const noexcept {
    return rows_[archetype * kYawSteps + yawStep];
  }
  std::span<const PuffColor> colors() const noexcept { return colors_; }
  const SkyColors& sky() const noexcept { return sky_; }
  const Vec3& sunDirection() const noexcept { return direction_; }
  /// As clouds of an archetype see it.
  Vec3 sunColor(std::uint32_t archetype) const noexcept;
  /// As the lowest clouds see it.
  const Vec3& sunColorAtGround() const noexcept { return sunColors_.front(); }
  Dimming dimming(std::uint32_t archetype) const noexcept;

 private:
  /// Share of the ambient sky that clouds of an archetype get.
  float skyShare(std::uint32_t archetype) const noexcept;
  struct Exposure {
    float exposure, face, lift;  ///< of radiances; the tone of a white face; of level tops
  };
  void lightRow(std::uint32_t archetype, std::uint32_t yawStep, const Exposure& set) noexcept;

  const PackView* pack_ = nullptr;
  std::vector<std::int64_t> rows_;
  std::vector<PuffColor> colors_;
  std::vector<Vec3> linear_, sunColors_;  ///< of one row; a height
  Vec3 direction_{0, 1, 0};
  SkyColors sky_;
};

}  // namespace cloudgen::runtime
