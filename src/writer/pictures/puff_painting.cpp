// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/puff_painting.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace cloudgen::writer {
namespace {

constexpr float kReach = 3;       ///< deviations
constexpr int kFewestPixels = 6;  ///< of the shorter side

/// A puff on the plane of a sight: a Gaussian by its middle and its covariances.
struct Footprint {
  glm::vec2 middle{0}, reach{0};
  float xx = 0, xy = 0, yy = 0, opticalDepth = 0, nearness = 0;
  glm::vec3 color{1};
};

Footprint footprintOf(const ColoredPuff& colored, const Sight& sight) {
  const shape::Puff& puff = colored.puff;
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  Footprint out;
  for (int i = 0; i < 3; ++i) {
    const float x = puff.sigma[i] * glm::dot(axes[i], sight.right),
                y = puff.sigma[i] * glm::dot(axes[i], sight.up);
    out.xx += x * x, out.xy += x * y, out.yy += y * y;
  }
  const double area = 2 * std::numbers::pi * std::sqrt(std::max(out.xx * out.yy - out.xy * out.xy, 1e-6f));
  out.middle = {glm::dot(puff.center, sight.right), glm::dot(puff.center, sight.up)};
  out.reach = kReach * glm::vec2(std::sqrt(out.xx), std::sqrt(out.yy));
  out.opticalDepth = static_cast<float>(shape::extinctionArea(puff) / area);
  out.nearness = glm::dot(puff.center, sight.towards);
  out.color = colored.color;
  return out;
}

/// Widens what is narrower than a pixel to it, with as much extinction.
void widen(Footprint& puff, const glm::vec2& step) {
  constexpr float kNarrowest = 0.35f;  // deviations, in pixels
  const float before = puff.xx * puff.yy - puff.xy * puff.xy;
  puff.xx += kNarrowest * kNarrowest * step.x * step.x;
  puff.yy += kNarrowest * kNarrowest * step.y * step.y;
  puff.opticalDepth *= std::sqrt(std::max(before, 1e-6f) / (puff.xx * puff.yy - puff.xy * puff.xy));
}

void paint(Footprint puff, const glm::vec2& lower, const glm::vec2& step, const glm::ivec2& size,
           std::vector<PaintedPixel>& canvas) {
  widen(puff, step);
  const glm::vec2 reach = kReach * glm::vec2(std::sqrt(puff.xx), std::sqrt(puff.yy));
  const glm::ivec2 low = glm::max(glm::ivec2((puff.middle - reach - lower) / step), 1),
                   high = glm::min(glm::ivec2((puff.middle + reach - lower) / step) + 1, size - 2);
  const float determinant = puff.xx * puff.yy - puff.xy * puff.xy;
  for (int row = low.y; row <= high.y; ++row)
    for (int column = low.x; column <= high.x; ++column) {
      const glm::vec2 away = lower + step * (glm::vec2(column, row) + 0.5f) - puff.middle;
      const float q =
          (puff.yy * away.x * away.x - 2 * puff.xy * away.x * away.y + puff.xx * away.y * away.y) /
          determinant;
      if (q > kReach * kReach) continue;
      const float opticalDepth = puff.opticalDepth * std::exp(-0.5f * q), alpha = -std::expm1(-opticalDepth);
      PaintedPixel& pixel =
          canvas[static_cast<std::size_t>(size.y - 1 - row) * static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(column)];
      pixel.color = alpha * puff.color + (1 - alpha) * pixel.color;
      pixel.nearness = alpha * puff.nearness + (1 - alpha) * pixel.nearness;
      pixel.alpha = alpha + (1 - alpha) * pixel.alpha;
      pixel.opticalDepth += opticalDepth;
    }
}

unsigned char byteOf(float value) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// Colours go on under what is hardly seen, so that filtering makes no fringe.
void appendBytes(const PaintedPixel& pixel, const glm::vec3& mean, std::vector<unsigned char>& bytes) {
  constexpr float kFaint = 0.01f;
  const glm::vec3 color = (pixel.color + kFaint * mean) / (pixel.alpha + kFaint);
  for (int c = 0; c < 3; ++c) bytes.push_back(byteOf(color[c]));
  bytes.push_back(byteOf(pixel.alpha));
}

/// Puffs from far to near, and the box around them.
struct Seen {
  std::vector<Footprint> footprints;
  glm::vec2 lower{1e30f}, upper{-1e30f};

  Seen(std::span<const ColoredPuff> puffs, const Sight& sight) {
    for (const ColoredPuff& puff : puffs) {
      footprints.push_back(footprintOf(puff, sight));
      lower = glm::min(lower, footprints.back().middle - footprints.back().reach);
      upper = glm::max(upper, footprints.back().middle + footprints.back().reach);
    }
    std::stable_sort(footprints.begin(), footprints.end(),
                     [](const Footprint& a, const Footprint& b) { return a.nearness < b.nearness; });
  }
  glm::vec2 sides() const { return glm::max(upper - lower, 1e-3f); }
};

/// Leaves out what is hardly seen at the borders, but for a pixel: it is blended, too. Returns where the
/// upper left corner of what is left was.
glm::ivec2 crop(PuffPicture& picture) {
  const image::ByteImage& whole = picture.image;
  const glm::ivec2 size(whole.width, whole.height);
  glm::ivec2 low = size, high(-1);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      if (whole.bytes[4 * static_cast<std::size_t>(y * size.x + x) + 3] >= kSeenAlpha) {
        low = glm::min(low, glm::ivec2(x, y));
        high = glm::max(high, glm::ivec2(x, y));
      }
  if (high.x < 0) return glm::ivec2(0);
  low = glm::max(low - 1, 0);
  high = glm::min(high + 2, size);
  image::ByteImage cropped{high.x - low.x, high.y - low.y, 4, {}};
  for (int y = low.y; y < high.y; ++y) {
    const auto row = whole.bytes.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * size.x + low.x);
    cropped.bytes.insert(cropped.bytes.end(), row, row + 4 * static_cast<std::ptrdiff_t>(cropped.width));
  }
  const glm::vec2 step = (picture.upper - picture.lower) / glm::vec2(size);
  picture.upper = picture.lower + step * glm::vec2(high.x, size.y - low.y);
  picture.lower += step * glm::vec2(low.x, size.y - high.y);
  picture.image = std::move(cropped);
  return low;
}

PuffPicture pictureOf(const Seen& seen, float pixelsPerMeter, int reliefCells) {
  constexpr int kMostPixels = 512;
  const glm::ivec2 size = glm::clamp(glm::ivec2(glm::ceil(pixelsPerMeter * seen.sides())) + 2,
                                     glm::ivec2(kFewestPixels), glm::ivec2(kMostPixels));
  const glm::vec2 step = seen.sides() / glm::vec2(size - 2);
  PuffPicture picture;
  picture.lower = seen.lower - step;
  picture.upper = seen.upper + step;
  std::vector<PaintedPixel> canvas(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (const Footprint& puff : seen.footprints) paint(puff, picture.lower, step, size, canvas);

  PaintedPixel sum;
  for (const PaintedPixel& pixel : canvas) {
    sum.color += pixel.color;
    sum.alpha += pixel.alpha;
    sum.nearness += pixel.nearness;
  }
  const float whole = std::max(sum.alpha, 1e-6f);
  picture.surface = sum.nearness / whole;
  picture.image = {size.x, size.y, 4, {}};
  picture.image.bytes.reserve(4 * canvas.size());
  for (const PaintedPixel& pixel : canvas) appendBytes(pixel, sum.color / whole, picture.image.bytes);
  const glm::ivec2 corner = crop(picture);
  if (reliefCells > 0)
    picture.relief = reliefOf(picture.image, picture.surface, {canvas, size.x, corner}, reliefCells);
  return picture;
}

}  // namespace

std::vector<glm::ivec4> patchesOf(const image::ByteImage& picture, int cells) {
  const int step = (std::max(picture.width, picture.height) + cells - 1) / cells;
  const auto isSeen = [&](int column, int row) {
    // One pixel more, which is looked up between.
    for (int y = std::max(0, row * step - 1); y < std::min(picture.height, (row + 1) * step + 1); ++y)
      for (int x = std::max(0, column * step - 1); x < std::min(picture.width, (column + 1) * step + 1); ++x)
        if (picture.bytes[4 * static_cast<std::size_t>(y * picture.width + x) + 3] >= kSeenAlpha) return true;
    return false;
  };
  const glm::ivec4 whole(picture.width, picture.height, picture.width, picture.height);
  std::vector<glm::ivec4> patches;
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      if (!isSeen(column, row)) continue;
      const int first = column;
      while (column + 1 < cells && isSeen(column + 1, row)) ++column;
      const glm::ivec4 patch = glm::min(step * glm::ivec4(first, row, column + 1, row + 1), whole);
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

PuffPicture paintedPuffs(std::span<const ColoredPuff> puffs, const Sight& sight, float pixelsPerMeter,
                         int reliefCells) {
  if (puffs.empty()) return {};
  return pictureOf(Seen(puffs, sight), pixelsPerMeter, reliefCells);
}

PuffPicture paintedPuffs(std::span<const ColoredPuff> puffs, const Sight& sight, int pixels) {
  if (puffs.empty()) return {};
  const Seen seen(puffs, sight);
  return pictureOf(seen, static_cast<float>(pixels - 2) / std::max(seen.sides().x, seen.sides().y), 0);
}

}  // namespace cloudgen::writer
