// SPDX-License-Identifier: Apache-2.0
#include "image/preview.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "image/backdrop.hpp"
#include "image/tiles.hpp"
#include "image/tone.hpp"
#include "image/volume.hpp"

namespace cloudgen::image {
namespace {

constexpr int kCoarser = 6;

glm::vec3 pixelColor(const Volume& volume, const Backdrop& backdrop, const View& view,
                     std::span<const Blob> blobs, int x, int y) {
  const Ray ray = view.rayAt(x + 0.5, y + 0.5);
  const double hidden = backdrop.distanceToTerrain(ray.origin, ray.direction);
  const Haze haze = backdrop.hazeAlong(ray.origin, ray.direction);
  const Gathered clouds = volume.along(ray, blobs, hidden, jitterAt(x, y), haze);
  // Thin ice sends less of the sun sideways than the many scatterings of a thick cloud do.
  glm::vec3 color = clouds.radiance * (1.0f - 0.3f * clouds.ice / (clouds.ice + clouds.water + 1e-6f) *
                                                  std::exp(-0.7f * (clouds.ice + clouds.water)));
  if (clouds.open > 0) color += clouds.open * backdrop.radianceAlong(ray.origin, ray.direction);
  if (!std::isfinite(hidden)) color += backdrop.sunlightThrough(ray.direction, clouds.water, clouds.ice);
  return displayed(color);
}

Picture renderView(std::span<const Splat> splats, const View& view, const Backdrop& backdrop,
                   const VolumeOptions& options, std::string_view stage, const base::Progress& progress) {
  const Volume volume(splats, view, options);
  Picture picture(view.width, view.height);
  forEachPixel(volume, view.width, view.height, stage, progress,
               [&](int x, int y, std::span<const Blob> blobs) {
                 picture.at(x, y) = pixelColor(volume, backdrop, view, blobs, x, y);
               });
  return picture;
}

/// Bilinear.
Picture enlarged(const Picture& small, int width, int height) {
  Picture large(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = std::clamp((static_cast<float>(x) + 0.5f) * static_cast<float>(small.width) /
                                         static_cast<float>(width) -
                                     0.5f,
                                 0.0f, static_cast<float>(small.width - 1)),
                  v = std::clamp((static_cast<float>(y) + 0.5f) * static_cast<float>(small.height) /
                                         static_cast<float>(height) -
                                     0.5f,
                                 0.0f, static_cast<float>(small.height - 1));
      const int i = static_cast<int>(u), j = static_cast<int>(v);
      const int i1 = std::min(i + 1, small.width - 1), j1 = std::min(j + 1, small.height - 1);
      const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
      large.at(x, y) = glm::mix(glm::mix(small.at(i, j), small.at(i1, j), s),
                                glm::mix(small.at(i, j1), small.at(i1, j1), s), t);
    }
  return large;
}

}  // namespace

Picture render(std::span<const Splat> splats, const Camera& camera, const Surroundings& surroundings,
               const RenderOptions& options, const base::Progress& progress) {
  progress.step("preview: shadows", 0);
  const Backdrop backdrop(splats, surroundings, camera.eye);
  VolumeOptions volume{.detail = false, .sunDirection = surroundings.sun.direction};
  const int width = camera.width / kCoarser, height = camera.height / kCoarser;
  if (options.coarse && width >= 32 && height >= 16) {
    Camera small = camera;
    small.width = width;
    small.height = height;
    options.coarse(enlarged(renderView(splats, viewOf(small), backdrop, volume, "preview: coarse", progress),
                            camera.width, camera.height));
  }
  volume.detail = options.detail;
  return renderView(splats, viewOf(camera), backdrop, volume, "preview", progress);
}

}  // namespace cloudgen::image
