// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "light/color.hpp"
#include "light/shade.hpp"
#include "shape/plan.hpp"

namespace cloudgen::writer {
namespace {

/// A puff with its colour, as seen from above.
struct Painted {
  shape::PlanGaussian plan;
  float opticalDepth;
  glm::vec3 color;  ///< sRGB
  float height;
  glm::vec2 reach;
};

constexpr float kReach = 3;  ///< deviations

std::vector<Painted> paintedFrom(const scene::Scene& scene, std::span<const std::uint32_t> instances) {
  std::vector<Painted> out;
  for (const std::uint32_t i : instances) {
    const scene::Instance& instance = scene.instances[i];
    const scene::LitArchetype& lit = scene.lit[instance.lit];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    const bool inParts = !archetype.farPuffs.empty();
    const std::span<const shape::Puff> puffs =
        inParts ? std::span(archetype.farPuffs) : std::span(&archetype.onePuff, 1);
    const std::span<const light::PuffLight> lights =
        inParts ? std::span(lit.farPuffs) : std::span(&lit.onePuff, 1);
    const glm::vec3 dimming = light::dimming(instance.sunlight, scene.sun.color, scene.sky);
    for (std::size_t p = 0; p < puffs.size(); ++p) {
      const shape::Puff puff = scene::placed(scene, instance, puffs[p]);
      const shape::PlanGaussian plan = shape::planOf(puff);
      const double area = 2 * std::numbers::pi * std::sqrt(std::max(plan.determinant(), 1e-6));
      out.push_back({plan, static_cast<float>(shape::extinctionArea(puff) / area),
                     light::srgbFromLinear(dimming * lights[p].color), puff.center.y,
                     kReach * glm::vec2(std::sqrt(plan.xx), std::sqrt(plan.zz))});
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Painted& a, const Painted& b) { return a.height < b.height; });
  return out;
}

unsigned char byteOf(float value) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// Colours have alpha multiplied into them; the lower are painted first.
image::ByteImage pictureOf(std::span<const Painted> puffs, const glm::vec2& lower, const glm::vec2& step,
                           int pixels) {
  const auto side = static_cast<std::size_t>(pixels);
  std::vector<glm::vec4> canvas(side * side, glm::vec4(0));
  glm::vec4 sum(0);
  for (const Painted& puff : puffs) {
    const glm::vec2 place(puff.plan.x, puff.plan.z);
    const glm::ivec2 low = glm::max(glm::ivec2((place - puff.reach - lower) / step), 1),
                     high = glm::min(glm::ivec2((place + puff.reach - lower) / step) + 1, pixels - 2);
    const auto determinant = static_cast<float>(puff.plan.determinant());
    for (int row = low.y; row <= high.y; ++row)
      for (int column = low.x; column <= high.x; ++column) {
        const glm::vec2 away = lower + step * (glm::vec2(column, row) + 0.5f) - place;
        const float q = (static_cast<float>(puff.plan.zz) * away.x * away.x -
                         2 * static_cast<float>(puff.plan.xz) * away.x * away.y +
                         static_cast<float>(puff.plan.xx) * away.y * away.y) /
                        determinant;
        if (q > kReach * kReach) continue;
        const float alpha = -std::expm1(-puff.opticalDepth * std::exp(-0.5f * q));
        glm::vec4& pixel = canvas[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
        pixel = glm::vec4(alpha * puff.color, alpha) + (1 - alpha) * pixel;
      }
  }
  for (const glm::vec4& pixel : canvas) sum += pixel;
  // Colours go on under what is hardly seen, so that filtering makes no fringe.
  constexpr float kFaint = 0.01f;
  const glm::vec3 mean = glm::vec3(sum) / std::max(sum.a, 1e-6f);
  image::ByteImage image{pixels, pixels, 4, {}};
  image.bytes.reserve(4 * canvas.size());
  for (const glm::vec4& pixel : canvas) {
    const glm::vec3 color = (glm::vec3(pixel) + kFaint * mean) / (pixel.a + kFaint);
    for (int c = 0; c < 3; ++c) image.bytes.push_back(byteOf(color[c]));
    image.bytes.push_back(byteOf(pixel.a));
  }
  return image;
}

/// Rectangles around what is seen, of pixels that are looked at so many together.
std::vector<glm::ivec4> patchesOf(const image::ByteImage& picture) {
  constexpr int kCells = 16;
  constexpr unsigned char kSeen = 2;
  const int step = picture.width / kCells;
  const auto isSeen = [&](int column, int row) {
    // One pixel more, which is looked up between.
    for (int y = std::max(0, row * step - 1); y < std::min(picture.height, (row + 1) * step + 1); ++y)
      for (int x = std::max(0, column * step - 1); x < std::min(picture.width, (column + 1) * step + 1); ++x)
        if (picture.bytes[4 * static_cast<std::size_t>(y * picture.width + x) + 3] >= kSeen) return true;
    return false;
  };
  std::vector<glm::ivec4> patches;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      if (!isSeen(column, row)) continue;
      const int first = column;
      while (column + 1 < kCells && isSeen(column + 1, row)) ++column;
      const glm::ivec4 patch = step * glm::ivec4(first, row, column + 1, row + 1);
      const auto above = std::find_if(patches.begin(), patches.end(), [&](const glm::ivec4& other) {
        return other.x == patch.x && other.z == patch.z && other.w == patch.y;
      });
      if (above == patches.end())
        patches.push_back(patch);
      else
        above->w = patch.w;
    }
  return patches;
}

}  // namespace

Sheet sheetOf(const scene::Scene& scene, std::span<const std::uint32_t> instances, int pixels) {
  const std::vector<Painted> puffs = paintedFrom(scene, instances);
  Sheet sheet;
  glm::vec2 lower(1e30f), upper(-1e30f);
  double height = 0, weight = 0;
  for (const Painted& puff : puffs) {
    const glm::vec2 place(puff.plan.x, puff.plan.z);
    lower = glm::min(lower, place - puff.reach);
    upper = glm::max(upper, place + puff.reach);
    const double own = static_cast<double>(puff.reach.x) * puff.reach.y * -std::expm1(-puff.opticalDepth);
    height += own * puff.height;
    weight += own;
  }
  sheet.height = static_cast<float>(height / std::max(weight, 1e-9));
  const glm::vec2 step = (upper - lower) / static_cast<float>(pixels - 2);
  sheet.lower = lower - step;
  sheet.upper = upper + step;
  sheet.picture = pictureOf(puffs, sheet.lower, step, pixels);
  sheet.patches = patchesOf(sheet.picture);
  return sheet;
}

SheetAtlas::SheetAtlas(std::span<const Sheet> sheets, int pixels) {
  const auto side = static_cast<std::size_t>(pixels), count = std::max<std::size_t>(sheets.size(), 1);
  across_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const std::size_t down = (count + across_ - 1) / across_;
  texture_ = {static_cast<int>(across_ * side), static_cast<int>(down * side), 4, {}};
  texture_.bytes.resize(4 * across_ * down * side * side, 0);
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t y = 0; y < side; ++y)
      std::copy_n(
          sheets[i].picture.bytes.begin() + static_cast<std::ptrdiff_t>(4 * y * side), 4 * side,
          texture_.bytes.begin() +
              static_cast<std::ptrdiff_t>(4 * (((i / across_) * side + y) * across_ + i % across_) * side));
}

QuadMesh SheetAtlas::meshOf(const Sheet& sheet, std::size_t index) const {
  QuadMesh mesh;
  const glm::vec2 step = (sheet.upper - sheet.lower) / static_cast<float>(sheet.picture.width);
  const glm::vec2 texture(texture_.width, texture_.height);
  const glm::vec2 corner =
      static_cast<float>(sheet.picture.width) * glm::vec2(index % across_, index / across_);
  for (const glm::ivec4& patch : sheet.patches) {
    const glm::vec2 low(patch.x, patch.y), high(patch.z, patch.w);
    const glm::vec2 middle = sheet.lower + 0.5f * step * (low + high), half = 0.5f * step * (high - low);
    const glm::vec2 from = (corner + low) / texture, to = (corner + high) / texture;
    const auto quad = static_cast<std::uint32_t>(mesh.quads.size());
    mesh.faces.insert(mesh.faces.end(), {2 * quad, 2 * quad + 1});  // the front looks up
    mesh.quads.push_back({glm::vec3(middle.x, sheet.height, middle.y), glm::vec3(half.x, 0, 0),
                          glm::vec3(0, 0, -half.y), glm::vec4(from.x, 1 - to.y, to.x, 1 - from.y),
                          glm::vec4(1), 0});
  }
  return mesh;
}

}  // namespace cloudgen::writer
