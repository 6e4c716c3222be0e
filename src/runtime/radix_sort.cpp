// SPDX-License-Identifier: Apache-2.0
#include "runtime/radix_sort.hpp"

#include <algorithm>
#include <bit>

namespace cloudgen::runtime {

RadixPass::RadixPass(int byte, std::span<const std::uint16_t> keys) noexcept : shift_(8 * byte) {
  for (const std::uint16_t key : keys) ++next_[key >> shift_ & 255];
  std::uint32_t before = 0;
  for (std::uint32_t& place : next_) {
    const std::uint32_t count = place;
    place = before;
    before += count;
  }
}

std::size_t RadixPass::advance(std::size_t most, std::span<const std::uint16_t> fromKeys, std::span<const DrawPuff> from,
                               std::span<std::uint16_t> toKeys, std::span<DrawPuff> to) noexcept {
  const std::size_t begin = moved_, end = moved_ + std::min(most, from.size() - moved_);
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t place = next_[fromKeys[i] >> shift_ & 255]++;
    toKeys[place] = fromKeys[i];
    to[place] = from[i];
  }
  moved_ = end;
  return end - begin;
}

std::uint16_t farFirst(float squaredMeters) noexcept {
  // The bits of a float above 1 rise nearly as its logarithm: 10 bits an octave of the square.
  const float kept = squaredMeters > 1 ? squaredMeters : 1.0f;
  const std::uint32_t rise = (std::bit_cast<std::uint32_t>(kept) - std::bit_cast<std::uint32_t>(1.0f)) >> 13;
  return static_cast<std::uint16_t>(0xffff - (rise < 0xffff ? rise : 0xffff));
}

}  // namespace cloudgen::runtime
