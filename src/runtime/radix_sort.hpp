// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// One pass of a stable sort: orders `from` by a byte of the keys (0 the low one) into `to`, and the keys along with
/// it. All spans are of one size.
void sortByByte(int byte, std::span<const std::uint16_t> fromKeys, std::span<const DrawPuff> from,
                std::span<std::uint16_t> toKeys, std::span<DrawPuff> to) noexcept;

/// A key that falls with the distance: far things come first. Resolves 1/2048 of a distance.
std::uint16_t farFirst(float squaredMeters) noexcept;

}  // namespace cloudgen::runtime
