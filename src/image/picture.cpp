// SPDX-License-Identifier: Apache-2.0
#include "image/picture.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace cloudgen::image {

void writePng(const std::filesystem::path& file, const ByteImage& image) {
  const auto fail = [&](const std::string& reason) {
    throw base::OutputError(file.string(), "cannot be written as PNG (" + reason + ")",
                            "check the folder, its permissions and the free space");
  };
  const std::filesystem::path beside = file.parent_path() / (file.stem().string() + ".part.png");
  auto writer = OIIO::ImageOutput::create("png");
  if (!writer) fail("OpenImageIO has no PNG writer");
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (image.channels == 2) {
    spec.channelnames = {"Y", "A"};
    spec.alpha_channel = 1;
  }
  if (image.channels != 3) spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("png:compressionLevel", 9);
  if (!writer->open(beside.string(), spec)) fail(writer->geterror());
  const bool written = writer->write_image(OIIO::TypeDesc::UINT8, image.bytes.data());
  const std::string reason = writer->geterror();
  if (!writer->close() || !written) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    fail(reason);
  }
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) fail(error.message());
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
