// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/card_picture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace cloudgen::writer {
namespace {

constexpr float kSeen = 1.5f / 255;  ///< alpha below which a pixel is cut off

/// A quad in the plane of the picture.
struct FlatQuad {
  glm::vec2 center, right, up;
  const Quad* quad;
};

glm::vec2 within(const ViewAxes& view, const glm::vec3& v) {
  return {glm::dot(view.x, v), glm::dot(view.y, v)};
}

/// The faces of a part that look to the viewer, in their order.
void append(const CloudPart& part, const ViewAxes& view, std::vector<FlatQuad>& out) {
  for (const std::uint32_t face : part.mesh.faces) {
    const Quad& quad = part.mesh.quads[face / 2];
    if (part.turns) {
      out.push_back({within(view, part.center) + glm::vec2(quad.center), glm::vec2(quad.right),
                     glm::vec2(quad.up), &quad});
      continue;
    }
    const float facing = glm::dot(glm::cross(quad.right, quad.up), view.z);
    if (face % 2 == 0 ? facing > 0 : facing < 0)
      out.push_back({within(view, quad.center), within(view, quad.right), within(view, quad.up), &quad});
  }
}

float depthOf(const CloudPart& part, const ViewAxes& view) {
  if (part.turns || part.mesh.quads.empty()) return glm::dot(part.center, view.z);
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const Quad& quad : part.mesh.quads) {
    lower = glm::min(lower, quad.center);
    upper = glm::max(upper, quad.center);
  }
  return glm::dot(0.5f * (lower + upper), view.z);
}

/// Far parts first, as viewers sort their Shapes.
std::vector<FlatQuad> seenQuads(const std::vector<CloudPart>& parts, const ViewAxes& view) {
  std::vector<const CloudPart*> order;
  for (const CloudPart& part : parts) order.push_back(&part);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return depthOf(*a, view) < depthOf(*b, view); });
  std::vector<FlatQuad> quads;
  for (const CloudPart* part : order) append(*part, view, quads);
  return quads;
}

/// Pixels that are drawn over each other; colours have alpha multiplied into them.
struct Canvas {
  glm::vec2 lower;
  float step;
  int width, height;
  std::vector<glm::vec4> pixels;

  glm::vec4& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }

  void blend(const FlatQuad& flat, const SpriteSheet& sprites, int spritePixels) {
    const float area = flat.right.x * flat.up.y - flat.right.y * flat.up.x;
    if (std::abs(area) < 1e-6f) return;
    const glm::vec2 reach = glm::abs(flat.right) + glm::abs(flat.up);
    const glm::vec2 low = (flat.center - reach - lower) / step, high = (flat.center + reach - lower) / step;
    const glm::vec4& box = flat.quad->textureBox;
    const glm::vec4& color = flat.quad->color;
    const SpriteSheet::Level& level =
        sprites.level(static_cast<float>(spritePixels) * step / (2 * std::sqrt(std::abs(area))));
    for (int y = std::max(0, static_cast<int>(low.y)); y < std::min(height, static_cast<int>(high.y) + 2);
         ++y)
      for (int x = std::max(0, static_cast<int>(low.x)); x < std::min(width, static_cast<int>(high.x) + 2);
           ++x) {
        const glm::vec2 away = lower + step * (glm::vec2(x, y) + 0.5f) - flat.center;
        const float s = (away.x * flat.up.y - away.y * flat.up.x) / area,
                    t = (flat.right.x * away.y - flat.right.y * away.x) / area;
        if (std::abs(s) > 1 || std::abs(t) > 1) continue;
        const glm::vec2 place =
            glm::mix(glm::vec2(box.x, box.y), glm::vec2(box.z, box.w), 0.5f * (glm::vec2(s, t) + 1.0f));
        const glm::vec4 texel = level.at(place);
        if (texel.a <= 0) continue;
        const glm::vec4 source(glm::vec3(texel) * glm::vec3(color) * color.a, texel.a * color.a);
        glm::vec4& pixel = at(x, y);
        pixel = source + (1 - source.a) * pixel;
      }
  }
};

unsigned char byteOf(float value) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// Cuts off what is not seen, all but a border of one pixel; the top row first. Colours go on under what is
/// hardly seen, so that filtering makes no fringe.
CardPicture cropped(Canvas& canvas) {
  int left = canvas.width, right = -1, bottom = canvas.height, top = -1;
  glm::vec4 sum(0);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      sum += canvas.at(x, y);
      if (canvas.at(x, y).a < kSeen) continue;
      left = std::min(left, x), right = std::max(right, x);
      bottom = std::min(bottom, y), top = std::max(top, y);
    }
  CardPicture picture;
  if (right < 0) return picture;
  left -= 1, bottom -= 1, right += 1, top += 1;
  picture.lower = canvas.lower + canvas.step * glm::vec2(left, bottom);
  picture.upper = canvas.lower + canvas.step * glm::vec2(right + 1, top + 1);
  picture.pixels = {right - left + 1, top - bottom + 1, 4, {}};
  const glm::vec3 mean = glm::vec3(sum) / sum.a;
  for (int y = top; y >= bottom; --y)
    for (int x = left; x <= right; ++x) {
      const bool isBorder = x == left || x == right || y == bottom || y == top;
      const glm::vec4 pixel = isBorder ? glm::vec4(0) : canvas.at(x, y);
      constexpr float kFaint = 0.01f;
      const glm::vec3 color = (glm::vec3(pixel) + kFaint * mean) / (pixel.a + kFaint);
      for (int c = 0; c < 3; ++c) picture.pixels.bytes.push_back(byteOf(color[c]));
      picture.pixels.bytes.push_back(byteOf(pixel.a));
    }
  return picture;
}

}  // namespace

ViewAxes viewAxes(int view) {
  if (view == kFromAbove) return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  constexpr float kDegree = std::numbers::pi_v<float> / 180;
  const float azimuth = 360 * kDegree * static_cast<float>(view) / kAzimuths,
              elevation = kElevationDegrees * kDegree;
  const glm::vec3 level(std::sin(azimuth), 0, -std::cos(azimuth));
  const glm::vec3 towards = std::cos(elevation) * level + std::sin(elevation) * glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::cross(glm::vec3(0, 1, 0), level);
  return {right, glm::cross(towards, right), towards};
}

CardPicture pictureOf(const std::vector<CloudPart>& parts, const SpriteSheet& sprites, int spritePixels,
                      const ViewAxes& view, float metersPerPixel) {
  const auto quads = seenQuads(parts, view);
  if (quads.empty()) return {};
  glm::vec2 lower(1e30f), upper(-1e30f);
  for (const FlatQuad& flat : quads) {
    const glm::vec2 reach = glm::abs(flat.right) + glm::abs(flat.up);
    lower = glm::min(lower, flat.center - reach);
    upper = glm::max(upper, flat.center + reach);
  }
  const glm::vec2 size = upper - lower;
  const float step = std::max(metersPerPixel, std::max(size.x, size.y) / (kMostPictureSide - 4));
  Canvas canvas{lower - 2 * step,
                step,
                static_cast<int>(std::ceil(size.x / step)) + 4,
                static_cast<int>(std::ceil(size.y / step)) + 4,
                {}};
  canvas.pixels.resize(static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height));
  for (const FlatQuad& flat : quads) canvas.blend(flat, sprites, spritePixels);
  return cropped(canvas);
}

}  // namespace cloudgen::writer
