// SPDX-License-Identifier: Apache-2.0
#include "image/tiles.hpp"

#include <algorithm>

#include "base/thread.hpp"

namespace cloudgen::image {
namespace {

constexpr int kTile = 32, kBlock = 8;

}  // namespace

void forEachPixel(const Volume& volume, int width, int height, std::string_view stage,
                  const base::Progress& progress,
                  const std::function<void(int x, int y, std::span<const Blob> blobs)>& draw) {
  const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
  for (int row = 0; row < rows; ++row) {
    progress.step(stage, static_cast<double>(row) / rows);
    const int top = row * kTile;
    const auto ofRow = volume.listFor(0, top, width, kTile, volume.all());
    base::parallelFor(static_cast<size_t>(columns), [&](size_t column) {
      const int left = static_cast<int>(column) * kTile;
      const auto ofTile = volume.listFor(left, top, kTile, kTile, ofRow);
      for (int blockY = top; blockY < std::min(top + kTile, height); blockY += kBlock)
        for (int blockX = left; blockX < std::min(left + kTile, width); blockX += kBlock) {
          const auto ofBlock = volume.blobsOf(volume.listFor(blockX, blockY, kBlock, kBlock, ofTile));
          for (int y = blockY; y < std::min(blockY + kBlock, height); ++y)
            for (int x = blockX; x < std::min(blockX + kBlock, width); ++x) draw(x, y, ofBlock);
        }
    });
  }
  progress.step(stage, 1);
}

}  // namespace cloudgen::image
