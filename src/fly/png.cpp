// SPDX-License-Identifier: Apache-2.0
#include "fly/png.hpp"

#include <GLES3/gl3.h>

#include "base/error.hpp"
#include "image/picture.hpp"

namespace cloudgen::fly {

bool decodePng(std::span<const std::uint8_t> png, runtime::gles::Pixels& pixels) {
  try {
    image::ByteImage image = image::imageFromPng(png);
    pixels = {image.width, image.height, std::move(image.bytes)};
    return true;
  } catch (const base::InputError&) {
    return false;
  }
}

runtime::gles::Pixels readPixels(int width, int height) {
  const auto row = std::size_t{4} * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> fromBelow(row * static_cast<std::size_t>(height)), fromAbove;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, fromBelow.data());
  fromAbove.reserve(fromBelow.size());
  for (auto at = fromBelow.end(); at != fromBelow.begin(); at -= static_cast<std::ptrdiff_t>(row))
    fromAbove.insert(fromAbove.end(), at - static_cast<std::ptrdiff_t>(row), at);
  return {width, height, std::move(fromAbove)};
}

void writeFrame(const std::filesystem::path& file, const runtime::gles::Pixels& pixels) {
  image::ByteImage image{pixels.width, pixels.height, 3, {}};
  for (std::size_t i = 0; i < pixels.rgba.size(); ++i)
    if (i % 4 != 3) image.bytes.push_back(pixels.rgba[i]);
  image::writePng(file, image);
}

}  // namespace cloudgen::fly
