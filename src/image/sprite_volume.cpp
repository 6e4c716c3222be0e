// SPDX-License-Identifier: Apache-2.0
#include "image/sprite_volume.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "base/noise.hpp"

namespace cloudgen::image {

SpriteTexture spriteTextureOf(base::Genus genus) {
  using base::Genus;
  switch (genus) {
    case Genus::Cirrus:
      return {3.2, 1.1, 0.0, 5.0, 0.05};
    case Genus::Cirrocumulus:
      return {2.6, 0.55, 0.6, 1.0, 0.0};
    case Genus::Cirrostratus:
      return {1.4, 0.35, 0.0, 2.5, 0.03};
    case Genus::Altocumulus:
      return {2.4, 0.6, 0.8, 1.2, 0.12};
    case Genus::Altostratus:
      return {1.6, 0.4, 0.0, 2.0, 0.08};
    case Genus::Nimbostratus:
      return {1.8, 0.5, 0.2, 1.4, 0.12};
    case Genus::Stratocumulus:
      return {2.2, 0.7, 0.8, 1.2, 0.18};
    case Genus::Stratus:
      return {1.6, 0.55, 0.1, 1.6, 0.08};
    case Genus::Cumulus:
      return {2.4, 0.85, 1.0, 1.0, 0.22};
    case Genus::Cumulonimbus:
      return {2.6, 0.8, 1.0, 1.0, 0.22};
    case Genus::Fog:
      break;
  }
  return {1.3, 0.4, 0.0, 1.6, 0.05};
}

std::vector<float> spriteVolume(const SpriteTexture& texture, std::uint64_t seed) {
  std::vector<float> volume(static_cast<size_t>(kSpriteVolume) * kSpriteVolume * kSpriteVolume);
  for (int z = 0; z < kSpriteVolume; ++z)
    for (int y = 0; y < kSpriteVolume; ++y)
      for (int x = 0; x < kSpriteVolume; ++x) {
        const glm::dvec3 p = (glm::dvec3(x, y, z) + 0.5) * (2.0 / kSpriteVolume) - 1.0;
        const double r2 = p.x * p.x + p.y * p.y + p.z * p.z;
        if (r2 >= 1.0) continue;
        const glm::dvec3 q(p.x * texture.frequency / std::sqrt(texture.stretch),
                           p.y * texture.frequency * std::sqrt(texture.stretch), p.z * texture.frequency);
        const double smooth = 0.5 + 0.7 * base::fractalNoise(q, 4, seed);
        const double round = 1.0 - 2.2 * (1.0 - base::billowNoise(q, 3, seed + 7));
        const double noise = smooth + texture.billow * (round - smooth);
        const double body = std::exp(-2.2 * r2) * (1.0 - base::smoothStep(0.75, 1.0, std::sqrt(r2)));
        volume[(static_cast<size_t>(z) * kSpriteVolume + y) * kSpriteVolume + x] = static_cast<float>(
            std::max(0.0, body - 1.5 * texture.erosion * (1.0 - body) * std::clamp(1.0 - noise, 0.0, 1.0)));
      }
  return volume;
}

}  // namespace cloudgen::image
