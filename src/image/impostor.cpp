// SPDX-License-Identifier: Apache-2.0
#include "image/impostor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "image/png_encoding.hpp"
#include "image/tiles.hpp"
#include "image/volume.hpp"
#include "light/color.hpp"

namespace cloudgen::image {
namespace {

/// As writers turn a puff into a splat: the silver lining in the harmonic of degree 1.
std::vector<Splat> splatsFrom(std::span<const shape::Puff> puffs, std::span<const light::PuffLight> lights,
                              const glm::vec3& sunColor) {
  std::vector<Splat> splats;
  splats.reserve(puffs.size());
  for (size_t i = 0; i < puffs.size(); ++i) {
    const light::EncodedLight shown = light::encoded(lights[i], sunColor);
    splats.push_back({puffs[i].center, puffs[i].sigma, puffs[i].rotation,
                      -std::expm1(-shape::frontalOpticalDepth(puffs[i])), shown.mean, shown.towardsSun});
  }
  return splats;
}

unsigned char toByte(float value) {
  return static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

glm::dvec3 hemiOctahedron(const glm::dvec2& uv) {
  // The square turned by 45 degrees is the diamond |x| + |z| <= 1 on the ground.
  const double x = 0.5 * (uv.x + uv.y), z = 0.5 * (uv.y - uv.x);
  return glm::normalize(glm::dvec3(x, std::max(0.0, 1.0 - std::abs(x) - std::abs(z)), z));
}

glm::dvec2 onHemiOctahedron(const glm::dvec3& direction) {
  const glm::dvec3 up(direction.x, std::max(0.0, direction.y), direction.z);
  const double sum = std::abs(up.x) + up.y + std::abs(up.z);
  if (!(sum > 0)) return glm::dvec2(0);
  return {(up.x - up.z) / sum, (up.x + up.z) / sum};
}

glm::dvec3 impostorDirection(int column, int row, int viewsAcross) {
  const double last = std::max(1, viewsAcross - 1);
  return hemiOctahedron({2.0 * column / last - 1.0, 2.0 * row / last - 1.0});
}

std::string depthPng(const ImpostorAtlas& atlas) {
  return encodedPng(OIIO::ImageSpec(atlas.color.width, atlas.color.height, 1, OIIO::TypeDesc::UINT16),
                    atlas.depth.data());
}

ImpostorAtlas bakeImpostor(std::span<const shape::Puff> puffs, std::span<const light::PuffLight> lights,
                           const light::Sun& sun, const ImpostorOptions& options,
                           const base::Progress& progress) {
  assert(puffs.size() == lights.size() && options.viewsAcross > 0 && options.tilePixels > 4);
  const int side = options.viewsAcross * options.tilePixels;
  const size_t pixels = static_cast<size_t>(side) * static_cast<size_t>(side);
  ImpostorAtlas atlas{options.viewsAcross, options.tilePixels};
  atlas.color = {side, side, 4, std::vector<unsigned char>(4 * pixels)};
  atlas.depth.assign(pixels, 65535);
  if (puffs.empty()) return atlas;
  const shape::Bounds bounds = shape::boundsOf(puffs, 3.0f);
  atlas.center = 0.5f * (bounds.lower + bounds.upper);
  for (const shape::Puff& puff : puffs)
    atlas.radiusMeters =
        std::max(atlas.radiusMeters, glm::length(puff.center - atlas.center) +
                                         3.0f * std::max({puff.sigma.x, puff.sigma.y, puff.sigma.z}));
  // Two pixels of room, for puffs widened to a pixel and for the border.
  atlas.radiusMeters *= 1.0f + 4.0f / static_cast<float>(options.tilePixels);
  const auto splats = splatsFrom(puffs, lights, sun.color);
  glm::dvec3 mean(0);
  double weight = 1e-9;
  for (const Splat& splat : splats) {
    mean += static_cast<double>(splat.opacity) * glm::dvec3(light::linearFromSrgb(splat.color));
    weight += splat.opacity;
  }
  const glm::vec3 unseen(mean / weight);

  for (int row = 0; row < options.viewsAcross; ++row)
    for (int column = 0; column < options.viewsAcross; ++column) {
      progress.step("impostor", static_cast<double>(row * options.viewsAcross + column) /
                                    (options.viewsAcross * options.viewsAcross));
      const double radius = atlas.radiusMeters;
      const View view =
          parallelView(glm::dvec3(atlas.center), impostorDirection(column, row, options.viewsAcross), radius,
                       radius, options.tilePixels);
      const Volume volume(splats, view, {options.detail, sun.direction});
      forEachPixel(
          volume, view.width, view.height, "impostor", {}, [&](int x, int y, std::span<const Blob> blobs) {
            const Gathered seen =
                volume.along(view.rayAt(x + 0.5, y + 0.5), blobs, 2 * radius, jitterAt(x, y), {});
            // Hardly seen pixels fade to the mean colour, so that filtering makes no fringe.
            const float alpha = 1 - seen.open;
            const glm::vec3 color =
                light::srgbFromLinear((seen.radiance + 0.004f * unseen) / (alpha + 0.004f));
            const size_t at = static_cast<size_t>(row * options.tilePixels + y) * static_cast<size_t>(side) +
                              static_cast<size_t>(column * options.tilePixels + x);
            for (int c = 0; c < 3; ++c) atlas.color.bytes[4 * at + static_cast<size_t>(c)] = toByte(color[c]);
            atlas.color.bytes[4 * at + 3] = toByte(alpha);
            if (alpha > 0.002f)
              atlas.depth[at] = static_cast<std::uint16_t>(
                  std::lround(65535 * std::clamp(seen.distance / (2 * radius), 0.0, 1.0)));
          });
    }
  progress.step("impostor", 1);
  return atlas;
}

}  // namespace cloudgen::image
