// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "base/progress.hpp"
#include "image/volume.hpp"

namespace cloudgen::image {

/// Calls `draw(x, y, blobs)` once for every pixel of a view, tile by tile on several threads, with the blobs
/// that its ray may meet.
void forEachPixel(const Volume& volume, int width, int height, std::string_view stage,
                  const base::Progress& progress,
                  const std::function<void(int x, int y, std::span<const Blob> blobs)>& draw);

}  // namespace cloudgen::image
