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

/// How long a PNG may take to be made small.
enum class PngEffort { Smallest, Quick };

/// A PNG file (through OpenImageIO); the same bytes for the same image. Throws OutputError.
std::string pngBytes(const ByteImage& image, PngEffort effort = PngEffort::Smallest);

/// The pixels of a PNG file, RGBA with straight alpha. Throws InputError.
ByteImage imageFromPng(std::span<const unsigned char> bytes);

/// Writes a PNG; the file is whole or absent. Throws OutputError.
void writePng(const std::filesystem::path& file, const ByteImage& image,
              PngEffort effort = PngEffort::Smallest);
void writePng(const std::filesystem::path& file, const Picture& picture);

/// Reads a PNG as four channels of 8 bits, straight alpha (255 where it has none). Throws InputError if it is
/// missing or is none.
ByteImage readPng(const std::filesystem::path& file);

}  // namespace cloudgen::image
