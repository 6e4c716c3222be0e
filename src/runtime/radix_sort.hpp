// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cloudgen::runtime {

/// A puff of a cloud: what is drawn. The GPU finds the rest by these two.
struct DrawPuff {
  std::uint32_t instance = 0;  ///< of the clouds that are drawn
  std::uint32_t puff = 0;      ///< of the pack
};

/// In the place of a puff: all of the cloud, as a picture of it.
inline constexpr std::uint32_t kImpostor = 0xffffffff;

/// One pass of a stable sort, in pieces: orders `from` by a byte of the keys (0 the low one) into `to`, and the keys along
/// with it. All spans are of one size, and the same for all pieces.
class RadixPass {
 public:
  RadixPass() = default;
  RadixPass(int byte, std::span<const std::uint16_t> keys) noexcept;
  /// Moves so many more, or what is left; how many.
  std::size_t advance(std::size_t most, std::span<const std::uint16_t> fromKeys, std::span<const DrawPuff> from,
                      std::span<std::uint16_t> toKeys, std::span<DrawPuff> to) noexcept;

 private:
  int shift_ = 0;
  std::array<std::uint32_t, 256> next_{};
  std::size_t moved_ = 0;
};

/// A key that falls with the distance: far things come first. Resolves 1/2048 of a distance.
std::uint16_t farFirst(float squaredMeters) noexcept;

}  // namespace cloudgen::runtime
