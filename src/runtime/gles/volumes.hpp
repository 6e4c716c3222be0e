// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "runtime/gles/puff_brush.hpp"

namespace cloudgen::runtime::gles {

/// Clouds as volumes: their pseudospheroids and how they are lit lie in grids, and rays are marched through those
/// (Jimenez de Parga 2018): within the cloud's box only, in steps that grow with the distance, until nothing shines through.
class Volumes {
 public:
  static constexpr int kSide = 40, kAcross = 6, kMost = kAcross * kAcross;

  /// Grids for the first kMost pairs of an archetype and a heading that clouds of the pack have.
  Status make(const Runtime& runtime) noexcept;
  /// At first, and after another sun: all light grids.
  void light() noexcept;
  /// Grid of a cloud, or kImpostor where it has none.
  std::uint32_t gridOf(const pack::Instance& cloud) const noexcept;
  void begin(const Camera& camera, const Texture& sky, const PackTextures& textures) noexcept;
  /// Draws a run of (cloud, grid), the farthest first.
  void draw(const Buffer& pairs, std::size_t first, std::size_t count) const noexcept { drawQuads(array_, pairs, first, count); }

 private:
  struct Grid {
    std::uint32_t archetype = 0, yawStep = 0;
  };
  void bake(std::uint32_t grid) noexcept;

  const Runtime* runtime_ = nullptr;
  Program program_;
  Texture cells_, boxes_;
  VertexArray array_;
  std::vector<Grid> grids_;
  std::vector<float> extinction_;  ///< of one grid: a cell's, and its colours weighed by it
  std::vector<std::uint8_t> texels_;
};

}  // namespace cloudgen::runtime::gles
