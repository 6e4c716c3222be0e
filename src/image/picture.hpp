// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace cloudgen::image {

/// Pixels row by row from the top, display-encoded (sRGB) colours, 0..1.
struct Picture {
  int width = 0, height = 0;
  std::vector<glm::vec3> pixels;

  Picture(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  glm::vec3& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  const glm::vec3& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

/// Bytes of an image, row by row from the top: 2 (grey, alpha), 3 or 4 channels of 8 bits.
struct ByteImage {
  int width = 0, height = 0, channels = 4;
  std::vector<unsigned char> bytes;
};

/// A PNG file (through OpenImageIO); the same bytes for the same image. Throws OutputError.
std::string pngBytes(const ByteImage& image);

/// The pixels of a PNG file, RGBA with straight alpha (255 where it has none). Throws InputError; also for
/// more than 16384 pixels along a side.
ByteImage imageFromPng(std::span<const unsigned char> bytes);

/// Writes a PNG; the file is whole or absent. Throws OutputError.
void writePng(const std::filesystem::path& file, const ByteImage& image);
void writePng(const std::filesystem::path& file, const Picture& picture);

}  // namespace cloudgen::image
