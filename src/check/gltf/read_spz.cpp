// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/read_spz.hpp"

#include <cmath>
#include <glm/common.hpp>

#include "base/error.hpp"
#include "base/gzip.hpp"

namespace cloudgen::check {
namespace {

constexpr std::size_t kHeaderBytes = 16, kMostSplats = 10'000'000;
constexpr std::uint32_t kMagic = 0x5053474e;

/// Columns of so many bytes a splat, one after another.
struct Columns {
  std::string_view positions, opacities, colors, scales, rotations, harmonics;
};

std::uint32_t byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  return byteAt(bytes, at) | byteAt(bytes, at + 1) << 8 | byteAt(bytes, at + 2) << 16 | byteAt(bytes, at + 3) << 24;
}

/// 24 bits with a sign.
std::int32_t fixedAt(std::string_view bytes, std::size_t at) {
  const std::uint32_t bits = byteAt(bytes, at) | byteAt(bytes, at + 1) << 8 | byteAt(bytes, at + 2) << 16;
  return bits & 0x800000 ? static_cast<std::int32_t>(bits) - (1 << 24) : static_cast<std::int32_t>(bits);
}

glm::vec3 tripleAt(std::string_view column, std::size_t splat) {
  return {byteAt(column, 3 * splat), byteAt(column, 3 * splat + 1), byteAt(column, 3 * splat + 2)};
}

/// Version 2: x, y and z in a byte each, w is what is left of 1.
glm::quat rotationOfBytes(std::string_view column, std::size_t splat) {
  const glm::vec3 part = tripleAt(column, splat) / 127.5f - 1.0f;
  const float rest = 1 - (part.x * part.x + part.y * part.y + part.z * part.z);
  return {std::sqrt(std::max(0.0f, rest)), part.x, part.y, part.z};
}

/// Version 3: the three smaller parts, last first, in 9 bits and a sign each; above them which is the largest.
glm::quat rotationOfWord(std::string_view column, std::size_t splat) {
  std::uint32_t word = wordAt(column, 4 * splat);
  const std::uint32_t largest = word >> 30;
  std::array<float, 4> parts{};
  float squares = 0;
  for (std::uint32_t i = 4; i-- > 0;) {
    if (i == largest) continue;
    const auto size = static_cast<float>(word & 511) / 511 * std::sqrt(0.5f);
    parts[i] = word & 512 ? -size : size;
    squares += size * size;
    word >>= 10;
  }
  parts[largest] = std::sqrt(std::max(0.0f, 1 - squares));
  return {parts[3], parts[0], parts[1], parts[2]};
}

}  // namespace

std::size_t readPackedSplats(std::string_view packed, const std::string& where,
                             const std::function<void(const ReadSplat&)>& visit) {
  static constexpr std::array<std::size_t, 4> kHarmonicsBytes{0, 9, 24, 45};
  const auto fail = [&](const char* what) -> void {
    throw base::InputError(where, what, "is it SPZ of version 2 or 3?");
  };
  const std::string bytes = base::unzipped(packed, where, kHeaderBytes + kMostSplats * (20 + 45));
  if (bytes.size() < kHeaderBytes || wordAt(bytes, 0) != kMagic) fail("holds no packed splats");
  const std::uint32_t version = wordAt(bytes, 4), degree = byteAt(bytes, 12), bits = byteAt(bytes, 13);
  const std::size_t count = wordAt(bytes, 8);
  if (version != 2 && version != 3) fail("has packed splats of another version");
  if (degree > 3 || bits > 23) fail("has packed splats with a header that cannot be");
  const std::size_t rotationBytes = version == 2 ? 3 : 4;
  if (count > kMostSplats ||
      bytes.size() != kHeaderBytes + count * (9 + 1 + 3 + 3 + rotationBytes + kHarmonicsBytes[degree]))
    fail("has packed splats of another number than it says");
  std::string_view rest = std::string_view(bytes).substr(kHeaderBytes);
  const auto take = [&](std::size_t each) {
    const std::string_view column = rest.substr(0, each * count);
    rest.remove_prefix(column.size());
    return column;
  };
  Columns columns;
  for (const auto& [column, each] : {std::pair{&columns.positions, std::size_t{9}},
                                     {&columns.opacities, 1},
                                     {&columns.colors, 3},
                                     {&columns.scales, 3},
                                     {&columns.rotations, rotationBytes},
                                     {&columns.harmonics, kHarmonicsBytes[degree]}})
    *column = take(each);
  const double unit = std::ldexp(1.0, -static_cast<int>(bits));
  for (std::size_t i = 0; i < count; ++i) {
    ReadSplat splat;
    for (int axis = 0; axis < 3; ++axis)
      splat.center[axis] =
          static_cast<float>(unit * fixedAt(columns.positions, 9 * i + 3 * static_cast<std::size_t>(axis)));
    splat.sigma = glm::exp(tripleAt(columns.scales, i) / 16.0f - 10.0f);
    splat.rotation = version == 2 ? rotationOfBytes(columns.rotations, i) : rotationOfWord(columns.rotations, i);
    splat.opacity = static_cast<float>(byteAt(columns.opacities, i)) / 255;
    splat.color = (tripleAt(columns.colors, i) / 255.0f - 0.5f) / 0.15f * 0.2820947917738781f + 0.5f;
    for (std::size_t k = 0; degree > 0 && k < 3; ++k)
      splat.harmonics[k] =
          (tripleAt(columns.harmonics.substr(kHarmonicsBytes[degree] * i), k) - 128.0f) / 128.0f;
    visit(splat);
  }
  return count;
}

}  // namespace cloudgen::check
