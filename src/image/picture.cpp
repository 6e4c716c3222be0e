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
  spec.attribute("png:compressionLevel", 9);
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
  return encodedPng(spec, image.bytes.data());
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
