// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/picture_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cloudgen::writer {

PictureAtlas packed(std::span<const CardPicture> pictures) {
  std::vector<std::size_t> order(pictures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return pictures[a].pixels.height > pictures[b].pixels.height; });
  double area = 0;
  int width = 1;
  for (const CardPicture& picture : pictures) {
    area += static_cast<double>(picture.pixels.width) * picture.pixels.height;
    width = std::max(width, picture.pixels.width);
  }
  width = std::max(width, static_cast<int>(std::ceil(std::sqrt(1.05 * area))));

  struct Place {
    int x = 0, y = 0;
  };
  std::vector<Place> places(pictures.size());
  Place next;
  int shelf = 0;
  for (const std::size_t i : order) {
    const image::ByteImage& pixels = pictures[i].pixels;
    if (next.x + pixels.width > width) next = {0, next.y + shelf}, shelf = 0;
    places[i] = next;
    next.x += pixels.width;
    shelf = std::max(shelf, pixels.height);
  }
  const int height = std::max(1, next.y + shelf);

  PictureAtlas atlas{{width, height, 4, {}}, {}};
  atlas.pixels.bytes.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const image::ByteImage& pixels = pictures[i].pixels;
    const auto row = 4 * static_cast<std::ptrdiff_t>(pixels.width);
    for (int y = 0; y < pixels.height; ++y)
      std::copy_n(pixels.bytes.begin() + y * row, row,
                  atlas.pixels.bytes.begin() +
                      4 * (static_cast<std::ptrdiff_t>(places[i].y + y) * width + places[i].x));
    atlas.boxes.push_back(
        glm::vec4(static_cast<float>(places[i].x) / static_cast<float>(width),
                  1 - static_cast<float>(places[i].y + pixels.height) / static_cast<float>(height),
                  static_cast<float>(places[i].x + pixels.width) / static_cast<float>(width),
                  1 - static_cast<float>(places[i].y) / static_cast<float>(height)));
  }
  return atlas;
}

}  // namespace cloudgen::writer
