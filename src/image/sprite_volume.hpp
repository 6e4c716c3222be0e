// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/genus.hpp"

namespace cloudgen::image {

inline constexpr int kSpriteVolume = 72;

/// How a genus's puffs are torn: by round billows or by smooth noise, drawn out sideways, deeply or hardly.
struct SpriteTexture {
  double frequency, erosion, billow, stretch, shading;
};

SpriteTexture spriteTextureOf(base::Genus genus);

/// Density in a cube of kSpriteVolume^3 about -1..1, x fastest, then y (up), then z (away from the eye): a
/// Gaussian ball whose skin the noise eats.
std::vector<float> spriteVolume(const SpriteTexture& texture, std::uint64_t seed);

}  // namespace cloudgen::image
