// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/preview.hpp"
#include "light/color.hpp"
#include "runtime/gles/headless.hpp"
#include "runtime/gles/renderer.hpp"
#include "scene/scene.hpp"

/// The same sky drawn by the runtime's renderer and by the compiler's.
namespace cloudgen::test {

inline bool decodePng(std::span<const std::uint8_t> png, runtime::gles::Pixels& pixels) {
  image::ByteImage image = image::imageFromPng(png);
  pixels = {image.width, image.height, std::move(image.bytes)};
  return true;
}

/// A framebuffer of a size.
struct Canvas {
  int width, height;
  runtime::gles::Texture color;
  runtime::gles::Framebuffer target;

  Canvas(int w, int h)
      : width(w),
        height(h),
        color(runtime::gles::newTexture2d(GL_RGBA8, w, h, runtime::gles::Filter::Nearest, runtime::gles::Border::Clamp)),
        target(runtime::gles::newFramebuffer(color)) {}

  image::Picture picture() const {
    std::vector<std::uint8_t> bytes(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    image::Picture out(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::uint8_t* const p = &bytes[4 * (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
        out.at(x, y) = glm::vec3(p[0], p[1], p[2]) / 255.0f;
      }
    return out;
  }
};

/// The puffs of a scene as the preview draws them.
inline std::vector<image::Splat> splatsOf(const scene::Scene& scene) {
  std::vector<image::Splat> splats;
  for (const scene::Instance& cloud : scene.instances) {
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    const auto& puffs = scene.archetypes[lit.archetype].puffs;
    for (std::size_t p = 0; p < puffs.size(); ++p) {
      const shape::Puff puff = scene::placed(scene, cloud, puffs[p]);
      const float opacity = 1 - std::exp(-shape::frontalOpticalDepth(puff));
      splats.push_back({puff.center, puff.sigma, puff.rotation, opacity, light::srgbFromLinear(lit.puffs[p].color), glm::vec3(0)});
    }
  }
  return splats;
}

inline image::Camera previewCamera(const runtime::Camera& camera) {
  const glm::dvec3 eye(camera.eye.x, camera.eye.y, camera.eye.z);
  return {eye, eye + 1000.0 * glm::dvec3(camera.forward.x, camera.forward.y, camera.forward.z),
          57.29577951 * static_cast<double>(camera.verticalFieldRadians), camera.widthPixels, camera.heightPixels};
}

inline image::Picture preview(const scene::Scene& scene, const runtime::Camera& camera, bool detail) {
  image::Surroundings surroundings;
  surroundings.sun = scene.sun;
  surroundings.sky = scene.sky;
  surroundings.groundHeightMeters = scene.groundHeightMeters;
  return image::render(splatsOf(scene), previewCamera(camera), surroundings, {.detail = detail}, {});
}

}  // namespace cloudgen::test
