// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/pack_view.hpp"

namespace cloudgen::runtime {

struct EndlessOptions {
  std::string_view weatherCode = "d200";
  std::uint64_t seed = 1;
  float nearestMeters = 20'000;  ///< no cloud appears nearer, horizontally
};

/// What a weather code asks for at one height.
struct EndlessLayer {
  std::string_view genera;  ///< abbreviations that may stand for it, the best first: "Ci Cs Cc"
  int clouds = 0;
  float lowestMeters = 0, highestMeters = 0;  ///< of their bases
  float apartMeters = 0;                      ///< at least, between their middles
  float widthMeters = 0;                      ///< of a sheet; 0 keeps the archetype's own
  bool clustered = false;
};

/// The layers of a code: d000 clear, d100 few (10), d200 some (30), d300 many (75), d400 overcast (200, clustered),
/// with n for d as well; cumulus and stratocumulus lowest, up to two sheets of altostratus above, up to two of cirrus
/// highest. Null for any other code.
const std::vector<EndlessLayer>* layersOf(std::string_view weatherCode) noexcept;

/// A sky without end of a pack's archetypes: a square about the eye always holds the clouds of a weather code, of the
/// same sizes; the ones left behind stand again ahead, at new places. Where a cloud stands is a function of the seed,
/// its number and the square it is in: the same seed has the same sky wherever one comes from, and again when one
/// returns.
class EndlessSky {
 public:
  EndlessSky() = default;
  /// Makes the clouds; layers whose genera the pack lacks are left out. The pack must stay where it is.
  static Status make(const PackView& pack, const EndlessOptions& options, EndlessSky& sky) noexcept;

  /// Brings the clouds about an eye; how many were moved. Nothing is allocated.
  std::size_t moveTo(const Vec3& eye) noexcept;
  std::span<const pack::Instance> instances() const noexcept { return clouds_; }
  /// Side of the square that holds them.
  float sideMeters() const noexcept { return side_; }

 private:
  struct Slot {
    Vec3 middle, half;             ///< of its share of the square; clouds stand within, x and z
    float lowest = 0, highest = 0;
    std::uint64_t seed = 0;
    std::int64_t column = INT64_MIN, row = INT64_MIN;  ///< of the square that it stands in
  };
  void addLayer(const PackView& pack, const EndlessLayer& layer, std::uint64_t seed);
  void place(Slot& slot, pack::Instance& cloud) noexcept;

  float side_ = 0;
  std::vector<Slot> slots_;
  std::vector<pack::Instance> clouds_;
};

}  // namespace cloudgen::runtime
