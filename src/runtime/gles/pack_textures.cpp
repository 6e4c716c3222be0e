// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/pack_textures.hpp"

#include <algorithm>
#include <array>
#include <new>

namespace cloudgen::runtime::gles {
namespace {

constexpr int kMostRows = 16'384;  ///< more than this few devices take
/// Items a row of a texture, and texels an item.
constexpr int kAcross = 128, kPuffWords = 5, kCloudWords = 6, kArchetypeTexels = 5, kColorsAcross = 2048;
constexpr int kSpritePixels = 256, kSpriteLevels = 4;

int rowsFor(std::size_t items, int across) {
  return static_cast<int>((items + static_cast<std::size_t>(across) - 1) / static_cast<std::size_t>(across));
}

/// Items of so many texels each into the texture that is bound, whole rows first.
void uploadRows(std::size_t items, int across, int texelsEach, std::size_t bytesEach, GLenum format, GLenum type,
                const void* data) {
  const auto whole = static_cast<int>(items / static_cast<std::size_t>(across)),
             rest = static_cast<int>(items % static_cast<std::size_t>(across));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (whole > 0) glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, across * texelsEach, whole, format, type, data);
  const auto* const tail = static_cast<const std::uint8_t*>(data) +
                           static_cast<std::size_t>(whole) * static_cast<std::size_t>(across) * bytesEach;
  if (rest > 0) glTexSubImage2D(GL_TEXTURE_2D, 0, 0, whole, rest * texelsEach, 1, format, type, tail);
}

/// Where the alpha-weighted mean of each light becomes 128, and alphas add up to those of a Gaussian: what a puff's colour
/// and optical depth say of the whole of it stays true.
void normalise(Pixels& sheet, int columns, int rows) {
  std::array<double, 3> sums{};
  double alphas = 0, wanted = 0;
  for (int y = 0; y < sheet.height; ++y)
    for (int x = 0; x < sheet.width; ++x) {
      const std::uint8_t* const texel = &sheet.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet.width) + static_cast<std::size_t>(x))];
      for (std::size_t c = 0; c < 3; ++c) sums[c] += texel[c] * texel[3];
      alphas += texel[3];
      // 2.3 deviations to the edge of a tile (image/sprite_bake.hpp).
      const auto fromMiddle = [](int at, int size, int tiles) {
        const double place = (at + 0.5) * tiles / size;
        return 4.6 * (place - std::floor(place) - 0.5);
      };
      const double dx = fromMiddle(x, sheet.width, columns), dy = fromMiddle(y, sheet.height, rows);
      wanted += 255 * std::exp(-0.5 * (dx * dx + dy * dy));
    }
  if (!(alphas > 0)) return;
  const double gain = std::min(4.0, wanted / alphas);
  for (std::size_t i = 0; i + 3 < sheet.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean = std::max(1.0, sums[c] / alphas);
      sheet.rgba[i + c] = static_cast<std::uint8_t>(std::min(255.0, 128 * sheet.rgba[i + c] / mean + 0.5));
    }
    sheet.rgba[i + 3] = static_cast<std::uint8_t>(std::min(255.0, gain * sheet.rgba[i + 3] + 0.5));
  }
}

/// Bilinear, to the size of a layer.
Pixels fitted(const Pixels& sheet) {
  if (sheet.width == kSpritePixels && sheet.height == kSpritePixels) return sheet;
  Pixels out{kSpritePixels, kSpritePixels, std::vector<std::uint8_t>(std::size_t{4} * kSpritePixels * kSpritePixels)};
  const auto sample = [](int at, int size, int& low, int& high) {
    const float place = std::clamp((static_cast<float>(at) + 0.5f) * static_cast<float>(size) / kSpritePixels - 0.5f, 0.0f,
                                   static_cast<float>(size - 1));
    low = static_cast<int>(place);
    high = std::min(low + 1, size - 1);
    return place - static_cast<float>(low);
  };
  for (int y = 0; y < kSpritePixels; ++y)
    for (int x = 0; x < kSpritePixels; ++x) {
      int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
      const float u = sample(x, sheet.width, x0, x1), v = sample(y, sheet.height, y0, y1);
      const auto texel = [&](int i, int j, std::size_t c) {
        return static_cast<float>(sheet.rgba[4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(sheet.width) + static_cast<std::size_t>(i)) + c]);
      };
      for (std::size_t c = 0; c < 4; ++c) {
        const float value = (1 - v) * ((1 - u) * texel(x0, y0, c) + u * texel(x1, y0, c)) +
                            v * ((1 - u) * texel(x0, y1, c) + u * texel(x1, y1, c));
        out.rgba[4 * (static_cast<std::size_t>(y) * kSpritePixels + static_cast<std::size_t>(x)) + c] = static_cast<std::uint8_t>(value + 0.5f);
      }
    }
  return out;
}

}  // namespace

const char* const PackTextures::kReaders = R"(
uniform highp usampler2D uPuffs, uClouds;
uniform highp isampler2D uRows;
uniform highp sampler2D uArchetypes, uColors;

ivec2 placeOf(uint index, int texelsEach) { return ivec2(int(index & 127u) * texelsEach, int(index >> 7)); }

struct Cloud { vec3 position; uint archetype; uint yaw; float sunlight; float scale; float factor; };
Cloud cloudAt(uint index) {
  ivec2 at = placeOf(index, 6);
  uint x = texelFetch(uClouds, at, 0).r, y = texelFetch(uClouds, at + ivec2(1, 0), 0).r,
       z = texelFetch(uClouds, at + ivec2(2, 0), 0).r, w = texelFetch(uClouds, at + ivec2(3, 0), 0).r;
  return Cloud(uintBitsToFloat(uvec3(x, y, z)), w & 65535u, (w >> 16) & 255u, float(w >> 24) / 255.0,
               uintBitsToFloat(texelFetch(uClouds, at + ivec2(4, 0), 0).r),
               uintBitsToFloat(texelFetch(uClouds, at + ivec2(5, 0), 0).r));
}

/// lower side of the centres and layer of sprites; step of the centres and first puff; then what dims it in the shadow of
/// others: sun, the rest; then the sun's colour.
vec4 archetypeTexel(uint archetype, int texel) {
  return texelFetch(uArchetypes, placeOf(archetype, 5) + ivec2(texel, 0), 0);
}

/// In the archetype's axes, at its scale.
struct Puff { vec3 center; vec3 sigma; mat3 axes; float depth; int sprite; };
Puff puffAt(uint index, vec3 lower, vec3 stepSize) {
  ivec2 at = placeOf(index, 5);
  uint a = texelFetch(uPuffs, at, 0).r, b = texelFetch(uPuffs, at + ivec2(1, 0), 0).r,
       c = texelFetch(uPuffs, at + ivec2(2, 0), 0).r, q = texelFetch(uPuffs, at + ivec2(3, 0), 0).r,
       d = texelFetch(uPuffs, at + ivec2(4, 0), 0).r;
  Puff puff;
  puff.center = lower + stepSize * vec3(float(a & 65535u), float(a >> 16), float(b & 65535u));
  puff.sigma = vec3(unpackHalf2x16(b).y, unpackHalf2x16(c));
  vec3 three = (vec3(float(q & 1023u), float((q >> 10) & 1023u), float((q >> 20) & 1023u)) * (2.0 / 1023.0) - 1.0) * 0.70710678;
  float left = sqrt(max(0.0, 1.0 - dot(three, three)));
  uint missing = q >> 30;
  vec4 r = missing == 0u ? vec4(left, three) : missing == 1u ? vec4(three.x, left, three.yz)
         : missing == 2u ? vec4(three.xy, left, three.z) : vec4(three, left);
  r = normalize(r);
  puff.axes = mat3(1.0 - 2.0 * (r.y * r.y + r.z * r.z), 2.0 * (r.x * r.y + r.w * r.z), 2.0 * (r.x * r.z - r.w * r.y),
                   2.0 * (r.x * r.y - r.w * r.z), 1.0 - 2.0 * (r.x * r.x + r.z * r.z), 2.0 * (r.y * r.z + r.w * r.x),
                   2.0 * (r.x * r.z + r.w * r.y), 2.0 * (r.y * r.z - r.w * r.x), 1.0 - 2.0 * (r.x * r.x + r.y * r.y));
  puff.depth = unpackHalf2x16(d).x;
  puff.sprite = int((d >> 16) & 255u);
  return puff;
}

/// Colour and forward share of a puff, display-linear.
vec4 colorOf(Cloud cloud, uint puff, uint first) {
  uint row = cloud.archetype * 16u + cloud.yaw;
  int start = texelFetch(uRows, ivec2(int(row & 127u), int(row >> 7)), 0).r;
  uint color = uint(max(start, 0)) + puff - first;
  return texelFetch(uColors, ivec2(int(color & 2047u), int(color >> 11)), 0);
}

mat3 turnOf(uint yaw) {
  float angle = float(yaw) * 0.39269908;
  float c = cos(angle), s = sin(angle);
  return mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
}
)";

Status PackTextures::make(const PackView& pack, const Lighting& lighting, std::size_t mostClouds, DecodePng decode) noexcept {
  const std::size_t archetypes = pack.archetypes().size(), rows = archetypes * kYawSteps;
  const int puffRows = rowsFor(pack.puffs().size(), kAcross), cloudRows = rowsFor(mostClouds, kAcross),
            archetypeRows = rowsFor(archetypes, kAcross), colorRows = rowsFor(lighting.colors().size(), kColorsAcross);
  if (std::max({puffRows, cloudRows, archetypeRows, colorRows, rowsFor(rows, kAcross)}) > kMostRows)
    return {"the pack has more clouds or puffs than a texture holds"};
  const auto table = [](GLenum format, int across, int count) {
    return newTexture2d(format, across, std::max(count, 1), Filter::Nearest, Border::Clamp);
  };
  puffs_ = table(GL_R32UI, kAcross * kPuffWords, puffRows);
  uploadRows(pack.puffs().size(), kAcross, kPuffWords, sizeof(pack::Puff), GL_RED_INTEGER, GL_UNSIGNED_INT,
             pack.puffs().data());
  clouds_ = table(GL_R32UI, kAcross * kCloudWords, cloudRows);
  colors_ = table(GL_SRGB8_ALPHA8, kColorsAcross, colorRows);
  archetypes_ = table(GL_RGBA32F, kAcross * kArchetypeTexels, archetypeRows);
  try {
    archetypeTexels_.assign(archetypes * kArchetypeTexels * 4, 0.0f);
    std::vector<std::int32_t> starts(rows);
    for (std::uint32_t row = 0; row < rows; ++row)
      starts[row] = static_cast<std::int32_t>(lighting.firstColor(row / kYawSteps, row % kYawSteps));
    rows_ = table(GL_R32I, kAcross, rowsFor(rows, kAcross));
    uploadRows(rows, kAcross, 1, sizeof(std::int32_t), GL_RED_INTEGER, GL_INT, starts.data());
    if (const Status made = makeSprites(pack, decode); !made) return made;
  } catch (const std::bad_alloc&) {
    return {"there is no memory for the pack's pictures"};
  }
  setLight(pack, lighting);
  return glGetError() == GL_NO_ERROR ? Status{} : Status{"OpenGL has no room for the pack"};
}

Status PackTextures::makeSprites(const PackView& pack, DecodePng decode) {
  const auto& atlases = *pack.root().atlases();
  for (int side = 0; side < 2; ++side) {
    sprites_[side] = newTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, sprites_[side].id());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, kSpriteLevels, GL_RGBA8, kSpritePixels, kSpritePixels,
                   static_cast<GLsizei>(std::max<std::uint32_t>(atlases.size(), 1)));
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    for (std::uint32_t layer = 0; layer < atlases.size(); ++layer) {
      const pack::Atlas& atlas = *atlases.Get(layer);
      const auto* const file = side == 0 ? atlas.sixway_a() : atlas.sixway_b();
      Pixels sheet;
      if (!file || atlas.columns() == 0 || atlas.rows() == 0 || !decode({file->data(), file->size()}, sheet) || sheet.width <= 0 || sheet.height <= 0 ||
          sheet.rgba.size() != std::size_t{4} * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height))
        return {"a light map of the pack's sprites cannot be read"};
      normalise(sheet, atlas.columns(), atlas.rows());
      const Pixels layerPixels = fitted(sheet);
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(layer), kSpritePixels, kSpritePixels, 1, GL_RGBA,
                      GL_UNSIGNED_BYTE, layerPixels.rgba.data());
    }
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
  }
  return {};
}

void PackTextures::setLight(const PackView& pack, const Lighting& lighting) noexcept {
  float* out = archetypeTexels_.data();
  const auto put = [&](const Vec3& v, float fourth) {
    for (const float value : {v.x, v.y, v.z, fourth}) *out++ = value;
  };
  for (std::uint32_t a = 0; a < pack.archetypes().size(); ++a) {
    const pack::Archetype& archetype = *pack.root().archetypes()->Get(a);
    const Vec3 lower = vec3(*archetype.center_lower());
    const Dimming dimming = lighting.dimming(a);
    put(lower, archetype.atlas());
    put((vec3(*archetype.center_upper()) - lower) * (1.0f / 65535), static_cast<float>(pack.archetypes()[a].first[0]));
    const pack::Atlas& sheet = *pack.root().atlases()->Get(archetype.atlas());
    put(dimming.sun, static_cast<float>(sheet.columns()));
    put(dimming.other, static_cast<float>(sheet.rows()));
    put(lighting.sunColor(a), 0);
  }
  glBindTexture(GL_TEXTURE_2D, archetypes_.id());
  uploadRows(pack.archetypes().size(), kAcross, kArchetypeTexels, kArchetypeTexels * 4 * sizeof(float), GL_RGBA, GL_FLOAT,
             archetypeTexels_.data());
  glBindTexture(GL_TEXTURE_2D, colors_.id());
  uploadRows(lighting.colors().size(), kColorsAcross, 1, sizeof(PuffColor), GL_RGBA, GL_UNSIGNED_BYTE,
             lighting.colors().data());
}

void PackTextures::setClouds(std::span<const pack::Instance> clouds) noexcept {
  glBindTexture(GL_TEXTURE_2D, clouds_.id());
  uploadRows(clouds.size(), kAcross, kCloudWords, sizeof(pack::Instance), GL_RED_INTEGER, GL_UNSIGNED_INT, clouds.data());
}

int PackTextures::bind(const Program& program, int unit) const noexcept {
  bindTexture(program, "uPuffs", unit++, GL_TEXTURE_2D, puffs_);
  bindTexture(program, "uClouds", unit++, GL_TEXTURE_2D, clouds_);
  bindTexture(program, "uRows", unit++, GL_TEXTURE_2D, rows_);
  bindTexture(program, "uArchetypes", unit++, GL_TEXTURE_2D, archetypes_);
  bindTexture(program, "uColors", unit++, GL_TEXTURE_2D, colors_);
  bindTexture(program, "uSpritesA", unit++, GL_TEXTURE_2D_ARRAY, sprites_[0]);
  bindTexture(program, "uSpritesB", unit++, GL_TEXTURE_2D_ARRAY, sprites_[1]);
  return unit;
}

}  // namespace cloudgen::runtime::gles
