// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "runtime/gles/pack_textures.hpp"

namespace cloudgen::fly {

/// For runtime::gles::Renderer::make.
bool decodePng(std::span<const std::uint8_t> png, runtime::gles::Pixels& pixels);

/// Pixels of the framebuffer that is bound, row by row from the top.
runtime::gles::Pixels readPixels(int width, int height);

/// Throws OutputError.
void writeFrame(const std::filesystem::path& file, const runtime::gles::Pixels& pixels);

}  // namespace cloudgen::fly
