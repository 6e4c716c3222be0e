// SPDX-License-Identifier: Apache-2.0
#include "runtime/radix_sort.hpp"

#include <array>
#include <bit>

namespace cloudgen::runtime {

void sortByByte(int byte, std::span<const std::uint16_t> fromKeys, std::span<const DrawPuff> from,
                std::span<std::uint16_t> toKeys, std::span<DrawPuff> to) noexcept {
  const int shift = 8 * byte;
  std::array<std::uint32_t, 256> next{};
  for (const std::uint16_t key : fromKeys) ++next[key >> shift & 255];
  std::uint32_t before = 0;
  for (std::uint32_t& place : next) {
    const std::uint32_t count = place;
    place = before;
    before += count;
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::uint32_t place = next[fromKeys[i] >> shift & 255]++;
    toKeys[place] = fromKeys[i];
    to[place] = from[i];
  }
}

std::uint16_t farFirst(float squaredMeters) noexcept {
  // The bits of a float above 1 rise nearly as its logarithm: 10 bits an octave of the square.
  const float kept = squaredMeters > 1 ? squaredMeters : 1.0f;
  const std::uint32_t rise = (std::bit_cast<std::uint32_t>(kept) - std::bit_cast<std::uint32_t>(1.0f)) >> 13;
  return static_cast<std::uint16_t>(0xffff - (rise < 0xffff ? rise : 0xffff));
}

}  // namespace cloudgen::runtime
