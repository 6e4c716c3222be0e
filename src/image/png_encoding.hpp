// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace cloudgen::image {

/// A PNG of `pixels`, which are of the type and channels that `spec` names. Throws OutputError.
std::string encodedPng(OIIO::ImageSpec spec, const void* pixels);

}  // namespace cloudgen::image
