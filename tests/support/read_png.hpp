// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <stdexcept>

#include "image/picture.hpp"

namespace cloudgen::test {

/// The bytes of a PNG as they are stored: straight alpha.
inline image::ByteImage readPng(const std::filesystem::path& file) {
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);
  const auto reader = OIIO::ImageInput::open(file.string(), &wanted);
  if (!reader) throw std::runtime_error("cannot read " + file.string());
  const OIIO::ImageSpec& spec = reader->spec();
  image::ByteImage image{spec.width, spec.height, spec.nchannels, {}};
  image.bytes.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                     static_cast<std::size_t>(spec.nchannels));
  reader->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, image.bytes.data());
  return image;
}

}  // namespace cloudgen::test
