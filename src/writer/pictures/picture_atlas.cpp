// SPDX-License-Identifier: Apache-2.0
#include "writer/pictures/picture_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cloudgen::writer {

PictureAtlas::PictureAtlas(std::span<const image::ByteImage* const> pictures) : corners_(pictures.size()) {
  constexpr int kNarrowest = 64;
  double area = 0;
  int width = kNarrowest;
  for (const image::ByteImage* picture : pictures) {
    area += static_cast<double>(picture->width) * picture->height;
    width = std::max(width, picture->width);
  }
  while (static_cast<double>(width) * width < area) width *= 2;

  // Rows of pictures, the highest first.
  std::vector<std::size_t> order(pictures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pictures[a]->height > pictures[b]->height; });
  int left = 0, top = 0, bottom = 0;
  for (const std::size_t i : order) {
    if (left + pictures[i]->width > width) left = 0, top = bottom;
    corners_[i] = {left, top};
    left += pictures[i]->width;
    bottom = std::max(bottom, top + pictures[i]->height);
  }

  texture_ = {width, std::max(bottom, 1), 4, {}};
  texture_.bytes.resize(4 * static_cast<std::size_t>(texture_.width) *
                        static_cast<std::size_t>(texture_.height));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto row = 4 * static_cast<std::ptrdiff_t>(pictures[i]->width);
    for (int y = 0; y < pictures[i]->height; ++y)
      std::copy_n(pictures[i]->bytes.begin() + y * row, row,
                  texture_.bytes.begin() +
                      4 * (static_cast<std::ptrdiff_t>(corners_[i].y + y) * width + corners_[i].x));
  }
}

glm::vec4 PictureAtlas::textureBox(std::size_t picture, const glm::ivec4& pixels) const {
  const glm::vec2 size(texture_.width, texture_.height), corner(corners_[picture]);
  const glm::vec2 from = (corner + glm::vec2(pixels.x, pixels.y)) / size,
                  to = (corner + glm::vec2(pixels.z, pixels.w)) / size;
  return {from.x, 1 - to.y, to.x, 1 - from.y};
}

}  // namespace cloudgen::writer
