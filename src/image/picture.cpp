// SPDX-License-Identifier: Apache-2.0
#include "image/picture.hpp"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "image/png_encoding.hpp"

namespace cloudgen::image {

std::string encodedPng(OIIO::ImageSpec spec, const void* pixels) {
  const auto fail = [](const std::string& reason) {
    throw base::OutputError("PNG", "a picture cannot be encoded (" + reason + ")",
                            "check the installation of OpenImageIO");
  };
  auto writer = OIIO::ImageOutput::create("png");
  if (!writer) fail("OpenImageIO has no PNG writer");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  if (!writer->set_ioproxy(&proxy) || !writer->open("memory.png", spec)) fail(writer->geterror());
  const bool written = writer->write_image(spec.format, pixels);
  const std::string reason = writer->geterror();
  if (!writer->close() || !written) fail(reason);
  return {bytes.begin(), bytes.end()};
}

std::string pngBytes(const ByteImage& image) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (image.channels == 2) {
    spec.channelnames = {"Y", "A"};
    spec.alpha_channel = 1;
  }
  if (image.channels != 3) spec.attribute("oiio:UnassociatedAlpha", 1);
  // For pixels that PNG has filtered: as small as the slowest search for repetitions makes them, in an eighth of its time.
  spec.attribute("compression", "filtered");
  spec.attribute("png:compressionLevel", 6);
  return encodedPng(spec, image.bytes.data());
}

ByteImage imageFromPng(std::span<const unsigned char> bytes) {
  constexpr int kMostPixels = 1 << 14;  // along a side
  const auto fail = [](const std::string& reason) {
    throw base::InputError("PNG", "a picture cannot be read (" + reason + ")", "make the file again");
  };
  OIIO::Filesystem::IOMemReader proxy(const_cast<unsigned char*>(bytes.data()), bytes.size());
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);
  const auto reader = OIIO::ImageInput::create("png");
  OIIO::ImageSpec spec;
  if (!reader || !reader->set_ioproxy(&proxy)) fail("OpenImageIO has no PNG reader");
  if (!reader->open("memory.png", spec, wanted)) fail(reader->geterror());
  if (spec.nchannels < 1 || spec.nchannels > 4 || spec.width > kMostPixels || spec.height > kMostPixels)
    fail("of too many channels or pixels");
  const auto pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height),
             channels = static_cast<size_t>(spec.nchannels);
  std::vector<unsigned char> stored(pixels * channels);
  if (!reader->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, stored.data()))
    fail(reader->geterror());
  ByteImage image{spec.width, spec.height, 4, std::vector<unsigned char>(pixels * 4, 255)};
  const bool hasAlpha = channels % 2 == 0;
  for (size_t i = 0; i < pixels; ++i) {
    const unsigned char* from = &stored[channels * i];
    for (size_t c = 0; c < 3; ++c) image.bytes[4 * i + c] = from[channels > 2 ? c : 0];
    if (hasAlpha) image.bytes[4 * i + 3] = from[channels - 1];
  }
  return image;
}

void writePng(const std::filesystem::path& file, const ByteImage& image) {
  base::writeFile(file, pngBytes(image));
}

void writePng(const std::filesystem::path& file, const Picture& picture) {
  ByteImage image{picture.width, picture.height, 3, {}};
  image.bytes.reserve(picture.pixels.size() * 3);
  for (const glm::vec3& pixel : picture.pixels)
    for (int c = 0; c < 3; ++c)
      image.bytes.push_back(
          static_cast<unsigned char>(std::lround(255.0f * std::clamp(pixel[c], 0.0f, 1.0f))));
  writePng(file, image);
}

}  // namespace cloudgen::image
