// SPDX-License-Identifier: Apache-2.0
#include "image/sprite_maps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "image/sprite_volume.hpp"
#include "light/octaves.hpp"

namespace cloudgen::image {
namespace {

constexpr int kSide = kSpriteVolume;
constexpr float kStep = 3.6f / kSide;  // as the sprite itself is seen
constexpr float kFaint = 0.02f;        // where less is seen, the maps fade into their mean

size_t cellOf(int x, int y, int z) {
  return (static_cast<size_t>(z) * kSide + static_cast<size_t>(y)) * kSide + static_cast<size_t>(x);
}

/// Optical depth of every cell from the face of the cube that a light comes through: 0..2 from +x, +y,
/// +z, 3..5 from the opposite sides.
std::vector<float> depthsTowards(const std::vector<float>& volume, int side) {
  const int axis = side % 3;
  std::vector<float> depths(volume.size());
  for (int b = 0; b < kSide; ++b)
    for (int a = 0; a < kSide; ++a) {
      float depth = 0;
      for (int i = 0; i < kSide; ++i) {
        const int along = side < 3 ? kSide - 1 - i : i;
        const size_t cell = axis == 0   ? cellOf(along, a, b)
                            : axis == 1 ? cellOf(a, along, b)
                                        : cellOf(a, b, along);
        depths[cell] = depth + 0.5f * volume[cell] * kStep;
        depth += volume[cell] * kStep;
      }
    }
  return depths;
}

glm::vec3 outwards(const std::vector<float>& volume, int x, int y, int z) {
  const auto at = [&](int i, int j, int k) {
    const bool inside = i >= 0 && j >= 0 && k >= 0 && i < kSide && j < kSide && k < kSide;
    return inside ? volume[cellOf(i, j, k)] : 0.0f;
  };
  return {at(x - 2, y, z) - at(x + 2, y, z), at(x, y - 2, z) - at(x, y + 2, z),
          -(at(x, y, z - 2) - at(x, y, z + 2))};
}

}  // namespace

std::vector<MapTexel> mapsFromTheSide(const std::vector<float>& volume) {
  std::array<std::vector<float>, 6> depths;
  for (int side = 0; side < 6; ++side) depths[static_cast<size_t>(side)] = depthsTowards(volume, side);
  std::vector<MapTexel> texels(static_cast<size_t>(kSide) * kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      // Where nothing is seen: a ball's normal and half light.
      const glm::vec2 out = (glm::vec2(x, y) + 0.5f) * (2.0f / kSide) - 1.0f;
      const glm::vec3 ball =
          glm::normalize(glm::vec3(out, std::sqrt(std::max(0.05f, 1 - glm::dot(out, out)))));
      float through = 1, weight = kFaint;
      glm::vec3 normal = kFaint * ball;
      std::array<float, 6> light;
      light.fill(0.6f * kFaint);
      for (int z = 0; z < kSide && through > 1e-3f; ++z) {
        const size_t cell = cellOf(x, y, z);
        if (!(volume[cell] > 0)) continue;
        const float absorbed = through * -std::expm1(-volume[cell] * kStep);
        // What shows through from the far side would turn the normal away from the eye.
        glm::vec3 gradient = outwards(volume, x, y, z);
        gradient.z = std::abs(gradient.z);
        normal += absorbed * through * gradient / (glm::length(gradient) + 0.02f);
        for (size_t side = 0; side < 6; ++side)
          light[side] += absorbed * light::transmitted(4.3f * depths[side][cell]);
        weight += absorbed;
        through -= absorbed;
      }
      MapTexel& texel = texels[static_cast<size_t>(y) * kSide + static_cast<size_t>(x)];
      texel.normal = glm::normalize(normal + 1e-4f * ball);
      for (size_t side = 0; side < 6; ++side) texel.light[side] = light[side] / weight;
    }
  return texels;
}

void paintMaps(SpriteMaps& maps, const std::vector<MapTexel>& texels, double u, double v, int x, int y,
               unsigned char alpha) {
  const double px = std::clamp(u * kSide - 0.5, 0.0, kSide - 1.001),
               py = std::clamp(v * kSide - 0.5, 0.0, kSide - 1.001);
  const int i = static_cast<int>(px), j = static_cast<int>(py);
  glm::vec3 normal(0);
  std::array<float, 6> light{};
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1, up = corner >> 1;
    const float share = static_cast<float>((right ? px - i : 1 - px + i) * (up ? py - j : 1 - py + j));
    const MapTexel& texel = texels[static_cast<size_t>(j + up) * kSide + static_cast<size_t>(i + right)];
    normal += share * texel.normal;
    for (size_t side = 0; side < 6; ++side) light[side] += share * texel.light[side];
  }
  normal = 0.5f + 0.5f * glm::normalize(normal);
  const auto paint = [&](ByteImage& image, const glm::vec3& color) {
    unsigned char* pixel =
        image.bytes.data() +
        4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
    for (int c = 0; c < 3; ++c)
      pixel[c] = static_cast<unsigned char>(std::lround(255 * std::clamp(color[c], 0.0f, 1.0f)));
    pixel[3] = alpha;
  };
  paint(maps.normal, normal);
  paint(maps.sixwayA, {light[0], light[1], light[2]});
  paint(maps.sixwayB, {light[3], light[4], light[5]});
}

}  // namespace cloudgen::image
