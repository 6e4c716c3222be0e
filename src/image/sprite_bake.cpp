// SPDX-License-Identifier: Apache-2.0
#include "image/sprite_bake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/noise.hpp"
#include "base/thread.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

constexpr int kVolume = 72;

/// How a genus's puffs are torn: by round billows or by smooth noise, drawn out sideways, deeply or hardly.
struct Texture {
  double frequency, erosion, billow, stretch, shading;
};

Texture textureOf(base::Genus genus) {
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

/// Density in a cube of kVolume^3 about -1..1: a Gaussian ball whose skin the noise eats.
std::vector<float> densityVolume(const Texture& texture, std::uint64_t seed) {
  std::vector<float> volume(static_cast<size_t>(kVolume) * kVolume * kVolume);
  for (int z = 0; z < kVolume; ++z)
    for (int y = 0; y < kVolume; ++y)
      for (int x = 0; x < kVolume; ++x) {
        const glm::dvec3 p = (glm::dvec3(x, y, z) + 0.5) * (2.0 / kVolume) - 1.0;
        const double r2 = p.x * p.x + p.y * p.y + p.z * p.z;
        if (r2 >= 1.0) continue;
        const glm::dvec3 q(p.x * texture.frequency / std::sqrt(texture.stretch),
                           p.y * texture.frequency * std::sqrt(texture.stretch), p.z * texture.frequency);
        const double smooth = 0.5 + 0.7 * base::fractalNoise(q, 4, seed);
        const double round = 1.0 - 2.2 * (1.0 - base::billowNoise(q, 3, seed + 7));
        const double noise = smooth + texture.billow * (round - smooth);
        const double body = std::exp(-2.2 * r2) * (1.0 - base::smoothStep(0.75, 1.0, std::sqrt(r2)));
        volume[(static_cast<size_t>(z) * kVolume + y) * kVolume + x] = static_cast<float>(
            std::max(0.0, body - 1.5 * texture.erosion * (1.0 - body) * std::clamp(1.0 - noise, 0.0, 1.0)));
      }
  return volume;
}

struct Texel {
  float alpha = 0, light = 1;
};

/// Looks through the volume along z; light comes from above (y up) and thins on its way down.
std::vector<Texel> seenFromTheSide(const std::vector<float>& volume, double shading) {
  const float step = 3.6f / kVolume;
  std::vector<Texel> texels(static_cast<size_t>(kVolume) * kVolume);
  for (int x = 0; x < kVolume; ++x) {
    std::vector<float> fromAbove(kVolume, 0.0f);
    for (int y = kVolume - 1; y >= 0; --y) {
      float through = 1, light = 0, weight = 0;
      for (int z = 0; z < kVolume; ++z) {
        const float density = volume[(static_cast<size_t>(z) * kVolume + y) * kVolume + x];
        const float absorbed = through * (1 - std::exp(-density * step));
        light += absorbed * std::exp(-2.4f * fromAbove[z]);
        weight += absorbed;
        through -= absorbed;
        fromAbove[z] += density * step;
      }
      Texel& texel = texels[static_cast<size_t>(y) * kVolume + x];
      texel.alpha = 1 - through;
      // Where hardly anything is seen the light fades into a mean, so that filtered edges keep their tone.
      texel.light = static_cast<float>(1.0 - shading * (1.0 - (light + 0.6f * 0.02f) / (weight + 0.02f)));
    }
  }
  return texels;
}

Texel sampled(const std::vector<Texel>& texels, double u, double v) {
  const double x = std::clamp(u * kVolume - 0.5, 0.0, kVolume - 1.001),
               y = std::clamp(v * kVolume - 0.5, 0.0, kVolume - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float s = static_cast<float>(x - i), t = static_cast<float>(y - j);
  const auto at = [&](int di, int dj) { return texels[static_cast<size_t>(j + dj) * kVolume + i + di]; };
  const auto mixed = [&](auto member) {
    return (at(0, 0).*member * (1 - s) + at(1, 0).*member * s) * (1 - t) +
           (at(0, 1).*member * (1 - s) + at(1, 1).*member * s) * t;
  };
  return {mixed(&Texel::alpha), mixed(&Texel::light)};
}

void bakeTile(ByteImage& image, base::Genus genus, int tile) {
  const Texture texture = textureOf(genus);
  const auto volume = densityVolume(
      texture, 1000u * static_cast<std::uint64_t>(genus) + 17u * static_cast<std::uint64_t>(tile) + 3u);
  const auto texels = seenFromTheSide(volume, texture.shading);
  float peak = 0.05f;
  for (const Texel& texel : texels) peak = std::max(peak, texel.alpha);
  const int left = (tile % kSpriteTilesAcross) * kSpriteTilePixels,
            top = (tile / kSpriteTilesAcross) * kSpriteTilePixels;
  for (int y = 0; y < kSpriteTilePixels; ++y)
    for (int x = 0; x < kSpriteTilePixels; ++x) {
      const double u = (x + 0.5) / kSpriteTilePixels, v = 1.0 - (y + 0.5) / kSpriteTilePixels;
      const Texel texel = sampled(texels, u, v);
      const bool border = x == 0 || y == 0 || x == kSpriteTilePixels - 1 || y == kSpriteTilePixels - 1;
      unsigned char* pixel = image.bytes.data() + 2 * (static_cast<size_t>(top + y) * image.width + left + x);
      pixel[0] =
          static_cast<unsigned char>(std::lround(255 * light::srgbFromLinear(glm::vec3(texel.light)).x));
      pixel[1] =
          border ? 0 : static_cast<unsigned char>(std::lround(255 * std::min(1.0f, texel.alpha / peak)));
    }
}

}  // namespace

ByteImage bakeSprites(base::Genus genus) {
  const int side = kSpriteTilePixels * kSpriteTilesAcross;
  ByteImage image{side, side, 2, std::vector<unsigned char>(static_cast<size_t>(side) * side * 2)};
  base::parallelFor(kSpriteTilesAcross * kSpriteTilesAcross,
                    [&](size_t tile) { bakeTile(image, genus, static_cast<int>(tile)); });
  return image;
}

void writeSpriteSet(const std::filesystem::path& folder, const base::Progress& progress) {
  nlohmann::ordered_json manifest{
      {"description", "Sprites of cloudgen, made by `cloudgen textures`: straight alpha, sRGB"}};
  for (const base::Genus genus : base::allGenera()) {
    progress.step("textures", static_cast<double>(genus) / base::kGenusCount);
    const std::string file = fmt::format("{}.png", base::name(genus));
    writePng(folder / file, bakeSprites(genus));
    manifest["atlases"].push_back({{"genus", base::abbreviation(genus)},
                                   {"file", file},
                                   {"columns", kSpriteTilesAcross},
                                   {"rows", kSpriteTilesAcross},
                                   {"tile_pixels", kSpriteTilePixels}});
  }
  base::writeFile(folder / "manifest.json", manifest.dump(2) + "\n");
  progress.step("textures", 1);
}

}  // namespace cloudgen::image
