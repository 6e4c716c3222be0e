// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/gles/puff_brush.hpp"

namespace cloudgen::runtime::gles {

/// Pictures of far clouds, each as it is seen from here, drawn again once one has gone round it a little (Harris & Lastra
/// 2001, "Real-time cloud rendering"). Those that have no picture yet get theirs at once, the others a few a frame.
class Impostors {
 public:
  static constexpr int kTilePixels = 64, kTilesAcross = 16, kMost = kTilesAcross * kTilesAcross;

  Status make(const Runtime& runtime) noexcept;
  /// All are of an old sun.
  void forget() noexcept;
  /// Tile of a cloud that is a picture in this frame; draws it first where it must. The framebuffer that is bound changes.
  std::uint32_t tileOf(std::uint32_t cloud, const Frame& frame, const Camera& camera, const Texture& sky, PuffBrush& brush) noexcept;
  /// Before the tiles of a frame are asked for.
  void beginFrame() noexcept { redrawn_ = 0; ++now_; }
  /// Draws those of a run of (cloud, tile).
  void begin(const Camera& camera, const Texture& sky, const PackTextures& textures) noexcept;
  void draw(const Buffer& pairs, std::size_t first, std::size_t count) const noexcept { drawQuads(array_, pairs, first, count); }

 private:
  struct Tile {
    std::uint32_t cloud = 0xffffffff;
    std::uint32_t usedAt = 0;
    Vec3 towardsEye;
    float distance = 1, scale = 1, factor = 1;
    bool isOld = true;
  };
  std::uint32_t freeTile() const noexcept;
  void redraw(std::uint32_t tile, const Frame& frame, const Camera& camera, const Texture& sky, PuffBrush& brush) noexcept;

  const Runtime* runtime_ = nullptr;
  Program program_;
  Texture atlas_, places_;
  Framebuffer target_;
  Buffer buffer_;
  VertexArray array_;
  std::vector<std::int32_t> tileOf_;  ///< of each cloud, or -1
  std::vector<Tile> tiles_;
  std::vector<DrawPuff> puffs_;
  std::vector<std::pair<float, DrawPuff>> sorted_;
  int redrawn_ = 0;
  std::uint32_t now_ = 0;
};

}  // namespace cloudgen::runtime::gles
