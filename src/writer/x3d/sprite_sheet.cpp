// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/sprite_sheet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::writer {
namespace {

constexpr std::size_t kMostLevels = 6;

}  // namespace

const glm::vec4& SpriteSheet::Level::texel(int x, int y) const {
  const auto column = static_cast<std::size_t>(std::clamp(x, 0, width - 1)),
             row = static_cast<std::size_t>(std::clamp(y, 0, height - 1));
  return texels[row * static_cast<std::size_t>(width) + column];
}

SpriteSheet::SpriteSheet(const image::ByteImage& image) {
  assert(image.channels == 4);
  Level finest{image.width, image.height, {}};
  finest.texels.reserve(image.bytes.size() / 4);
  for (std::size_t i = 0; i + 3 < image.bytes.size(); i += 4) {
    const glm::vec4 color =
        glm::vec4(image.bytes[i], image.bytes[i + 1], image.bytes[i + 2], image.bytes[i + 3]) / 255.0f;
    finest.texels.emplace_back(glm::vec3(color) * color.a, color.a);
  }
  levels_.push_back(std::move(finest));
  while (levels_.size() < kMostLevels && std::min(levels_.back().width, levels_.back().height) > 1) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, {}};
    for (int y = 0; y < coarse.height; ++y)
      for (int x = 0; x < coarse.width; ++x)
        coarse.texels.push_back(0.25f * (fine.texel(2 * x, 2 * y) + fine.texel(2 * x + 1, 2 * y) +
                                         fine.texel(2 * x, 2 * y + 1) + fine.texel(2 * x + 1, 2 * y + 1)));
    levels_.push_back(std::move(coarse));
  }
}

const SpriteSheet::Level& SpriteSheet::level(float texelsPerPixel) const {
  const auto halvings = std::lround(std::log2(std::max(texelsPerPixel, 1.0f)));
  return levels_[static_cast<std::size_t>(std::min<long>(halvings, std::ssize(levels_) - 1))];
}

glm::vec4 SpriteSheet::Level::at(const glm::vec2& place) const {
  const float x = place.x * static_cast<float>(width) - 0.5f,
              y = (1 - place.y) * static_cast<float>(height) - 0.5f;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const float right = x - static_cast<float>(column), below = y - static_cast<float>(row);
  const glm::vec4 upper = texel(column, row) + right * (texel(column + 1, row) - texel(column, row)),
                  lower =
                      texel(column, row + 1) + right * (texel(column + 1, row + 1) - texel(column, row + 1));
  return upper + below * (lower - upper);
}

}  // namespace cloudgen::writer
