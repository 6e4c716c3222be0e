// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/gles/gl_objects.hpp"
#include "runtime/lighting.hpp"

namespace cloudgen::runtime::gles {

/// Pixels row by row from the top, RGBA.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Reads a PNG file with straight alpha; false where it cannot. The application brings it: it has one already. Must not
/// throw.
using DecodePng = bool (*)(std::span<const std::uint8_t> png, Pixels& pixels);

/// What the shaders read of a pack. The arrays of the file lie in textures as they are, word by word, and the vertex
/// shader takes them apart.
class PackTextures {
 public:
  /// `mostClouds` that are ever drawn.
  Status make(const PackView& pack, const Lighting& lighting, std::size_t mostClouds, DecodePng decode) noexcept;
  /// After another sun. Allocates nothing.
  void setLight(const PackView& pack, const Lighting& lighting) noexcept;
  void setClouds(std::span<const pack::Instance> clouds) noexcept;

  /// Makes the program that is current read them, from a texture unit on; the next free unit.
  int bind(const Program& program, int unit) const noexcept;

  /// GLSL: what unpacks them, for vertex shaders.
  static const char* const kReaders;

 private:
  Status makeSprites(const PackView& pack, DecodePng decode);

  Texture puffs_, clouds_, archetypes_, rows_, colors_, sprites_[2];
  std::vector<float> archetypeTexels_;
};

}  // namespace cloudgen::runtime::gles
