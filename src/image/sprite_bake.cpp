// SPDX-License-Identifier: Apache-2.0
#include "image/sprite_bake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/file.hpp"
#include "base/noise.hpp"
#include "base/thread.hpp"
#include "image/sprite_atlas.hpp"
#include "image/sprite_maps.hpp"
#include "image/sprite_volume.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

struct Texel {
  float alpha = 0, light = 1;
};

/// Looks through the volume along z; light comes from above (y up) and thins on its way down.
std::vector<Texel> seenFromTheSide(const std::vector<float>& volume, double shading) {
  const float step = 3.6f / kSpriteVolume;
  std::vector<Texel> texels(static_cast<size_t>(kSpriteVolume) * kSpriteVolume);
  for (int x = 0; x < kSpriteVolume; ++x) {
    std::vector<float> fromAbove(kSpriteVolume, 0.0f);
    for (int y = kSpriteVolume - 1; y >= 0; --y) {
      float through = 1, light = 0, weight = 0;
      for (int z = 0; z < kSpriteVolume; ++z) {
        const float density = volume[(static_cast<size_t>(z) * kSpriteVolume + y) * kSpriteVolume + x];
        const float absorbed = through * (1 - std::exp(-density * step));
        light += absorbed * std::exp(-2.4f * fromAbove[z]);
        weight += absorbed;
        through -= absorbed;
        fromAbove[z] += density * step;
      }
      Texel& texel = texels[static_cast<size_t>(y) * kSpriteVolume + x];
      texel.alpha = 1 - through;
      // Where hardly anything is seen the light fades into a mean, so that filtered edges keep their tone.
      texel.light = static_cast<float>(1.0 - shading * (1.0 - (light + 0.6f * 0.02f) / (weight + 0.02f)));
    }
  }
  return texels;
}

Texel sampled(const std::vector<Texel>& texels, double u, double v) {
  const double x = std::clamp(u * kSpriteVolume - 0.5, 0.0, kSpriteVolume - 1.001),
               y = std::clamp(v * kSpriteVolume - 0.5, 0.0, kSpriteVolume - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float s = static_cast<float>(x - i), t = static_cast<float>(y - j);
  const auto at = [&](int di, int dj) {
    return texels[static_cast<size_t>(j + dj) * kSpriteVolume + i + di];
  };
  const auto mixed = [&](auto member) {
    return (at(0, 0).*member * (1 - s) + at(1, 0).*member * s) * (1 - t) +
           (at(0, 1).*member * (1 - s) + at(1, 1).*member * s) * t;
  };
  return {mixed(&Texel::alpha), mixed(&Texel::light)};
}

/// What a sprite stands for has ended before its border, in half-sides, so that no quad's edge is seen.
double withinBorder(double u, double v) {
  return 1 - base::smoothStep(0.85, 1, std::hypot(2 * u - 1, 2 * v - 1));
}

/// A tile's window on the volume, about its middle.
struct Window {
  const std::vector<Texel>& texels;
  float peak;
  double zoom = 1;  ///< sides of the volume that it shows

  static double into(double place, double zoom) { return 0.5 + zoom * (place - 0.5); }
  Texel at(double u, double v) const {
    Texel texel = sampled(texels, into(u, zoom), into(v, zoom));
    texel.alpha = std::min(1.0f, texel.alpha / peak) * static_cast<float>(withinBorder(u, v));
    return texel;
  }
  /// Mean alpha.
  double opacity() const {
    double sum = 0;
    for (int y = 0; y < kSpriteVolume; ++y)
      for (int x = 0; x < kSpriteVolume; ++x)
        sum += static_cast<double>(at((x + 0.5) / kSpriteVolume, (y + 0.5) / kSpriteVolume).alpha);
    return sum / (kSpriteVolume * kSpriteVolume);
  }
};

/// Torn as they are, sprites are narrower than the Gaussians that they stand for: shows as much of the volume as
/// makes the sprite as opaque on the mean.
Window windowOn(const std::vector<Texel>& texels) {
  constexpr double kOpacity = 0.5 * std::numbers::pi * kWithinSprite / (kSpriteReach * kSpriteReach);
  Window window{texels, 0.05f};
  for (const Texel& texel : texels) window.peak = std::max(window.peak, texel.alpha);
  double least = 0.3, most = 1.2;
  for (int pass = 0; pass < 12; ++pass) {
    window.zoom = 0.5 * (least + most);
    (window.opacity() < kOpacity ? most : least) = window.zoom;
  }
  return window;
}

void bakeTile(ByteImage& image, SpriteMaps* maps, base::Genus genus, int tile) {
  const SpriteTexture texture = spriteTextureOf(genus);
  const auto volume = spriteVolume(
      texture, 1000u * static_cast<std::uint64_t>(genus) + 17u * static_cast<std::uint64_t>(tile) + 3u);
  const auto texels = seenFromTheSide(volume, texture.shading);
  const auto mapTexels = maps ? mapsFromTheSide(volume) : std::vector<MapTexel>();
  const Window window = windowOn(texels);
  const int left = (tile % kSpriteTilesAcross) * kSpriteTilePixels,
            top = (tile / kSpriteTilesAcross) * kSpriteTilePixels;
  for (int y = 0; y < kSpriteTilePixels; ++y)
    for (int x = 0; x < kSpriteTilePixels; ++x) {
      const double u = (x + 0.5) / kSpriteTilePixels, v = 1.0 - (y + 0.5) / kSpriteTilePixels;
      const Texel texel = window.at(u, v);
      const bool border = x == 0 || y == 0 || x == kSpriteTilePixels - 1 || y == kSpriteTilePixels - 1;
      unsigned char* pixel = image.bytes.data() + 2 * (static_cast<size_t>(top + y) * image.width + left + x);
      pixel[0] =
          static_cast<unsigned char>(std::lround(255 * light::srgbFromLinear(glm::vec3(texel.light)).x));
      pixel[1] =
          border ? 0 : static_cast<unsigned char>(std::lround(255 * texel.alpha));
      if (maps)
        paintMaps(*maps, mapTexels, Window::into(u, window.zoom), Window::into(v, window.zoom), left + x, top + y,
                  pixel[1]);
    }
}

}  // namespace

SpriteSheets bakeSprites(base::Genus genus, bool withMaps) {
  const int side = kSpriteTilePixels * kSpriteTilesAcross;
  const auto sheet = [&](int channels) {
    return ByteImage{
        side, side, channels,
        std::vector<unsigned char>(static_cast<size_t>(side) * side * static_cast<size_t>(channels))};
  };
  SpriteSheets sheets;
  sheets.color = sheet(2);
  if (withMaps) sheets.maps = SpriteMaps{sheet(4), sheet(4), sheet(4)};
  base::parallelFor(kSpriteTilesAcross * kSpriteTilesAcross, [&](size_t tile) {
    bakeTile(sheets.color, sheets.maps ? &*sheets.maps : nullptr, genus, static_cast<int>(tile));
  });
  return sheets;
}

ByteImage halved(const ByteImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  ByteImage half{image.width / 2, image.height / 2, image.channels, {}};
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        int sum = 2;
        for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
          sum += image.bytes[channels * static_cast<std::size_t>((2 * y + dy) * image.width + 2 * x + dx) + c];
        half.bytes.push_back(static_cast<unsigned char>(sum / 4));
      }
  return half;
}

void writeSpriteSet(const std::filesystem::path& folder, bool withNormals, const base::Progress& progress) {
  nlohmann::ordered_json manifest{
      {"description", "Sprites of cloudgen, made by `cloudgen textures`: straight alpha, sRGB"},
      {"maps",
       "linear, not sRGB. sixway_a: light from the right, above, behind; sixway_b: from the left, below, the front; at half "
       "the resolution. normal: x right, y up, z to the eye as 0.5 + 0.5 n. Alpha as in the sprite"}};
  for (const base::Genus genus : base::allGenera()) {
    progress.step("textures", static_cast<double>(genus) / base::kGenusCount);
    const std::string name(base::name(genus)), file = name + ".png";
    const SpriteSheets sheets = bakeSprites(genus, true);
    writePng(folder / file, sheets.color);
    nlohmann::ordered_json entry{{"genus", base::abbreviation(genus)},
                                 {"file", file},
                                 {"columns", kSpriteTilesAcross},
                                 {"rows", kSpriteTilesAcross},
                                 {"tile_pixels", kSpriteTilePixels}};
    const auto add = [&](const std::string& kind, const ByteImage& image) {
      entry[kind] = fmt::format("{}.{}.png", name, kind);
      writePng(folder / entry[kind].get<std::string>(), image);
    };
    add("sixway_a", halved(sheets.maps->sixwayA));
    add("sixway_b", halved(sheets.maps->sixwayB));
    if (withNormals) add("normal", sheets.maps->normal);
    manifest["atlases"].push_back(std::move(entry));
  }
  base::writeFile(folder / "manifest.json", manifest.dump(2) + "\n");
  progress.step("textures", 1);
}

}  // namespace cloudgen::image
