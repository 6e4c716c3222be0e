// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "runtime/gles/gl_objects.hpp"
#include "runtime/gles/impostors.hpp"
#include "runtime/gles/pack_textures.hpp"
#include "runtime/gles/puff_brush.hpp"
#include "runtime/gles/resolution.hpp"
#include "runtime/gles/sky_table.hpp"
#include "runtime/gles/volumes.hpp"
#include "runtime/runtime.hpp"

namespace cloudgen::runtime::gles {

struct RendererOptions {
  /// Clouds are drawn at this share of the picture's resolution, at most.
  float finestScale = 1;
  /// They are drawn coarser where frames take longer than this; 0: never.
  float targetMilliseconds = 0;
  /// Clouds that the runtime hands over as a whole (DetailOptions::impostorPixels) are marched through instead of being
  /// pictures of themselves.
  bool volumes = false;
};

/// Draws what a runtime says into a framebuffer, with OpenGL ES 3.0: sky, ground with the clouds' shadows, the clouds by
/// their puffs, far ones first, and haze. The runtime must outlive it, and the context in which it was made must be
/// current. Nothing throws; nothing is allocated by `draw`.
class Renderer {
 public:
  /// For pictures of at most this size.
  Status make(const Runtime& runtime, DecodePng decode, int mostWidth, int mostHeight, const RendererOptions& options) noexcept;
  /// After Runtime::setSun.
  void setLight() noexcept;
  /// `frameMilliseconds` is what the frame before took.
  void draw(const Frame& frame, const Camera& camera, GLuint framebuffer, double frameMilliseconds = 0) noexcept;
  /// Share of the picture's resolution that the clouds are drawn at now.
  float scale() const noexcept { return resolution_.scale(); }

 private:
  Status makePrograms() noexcept;
  void makePatches();
  void upload(const Frame& frame, const Camera& camera) noexcept;
  void drawShadows(const Frame& frame) noexcept;
  void drawClouds(const Frame& frame, const Camera& camera) noexcept;
  void drawBackdrop(const Camera& camera) noexcept;
  void drawPicture(const Camera& camera, GLuint framebuffer) noexcept;
  void lightFrom(float eyeHeight) noexcept;

  const Runtime* runtime_ = nullptr;
  RendererOptions options_;
  Resolution resolution_;
  PackTextures textures_;
  std::unique_ptr<SkyTable> skyTable_;
  Program backdropProgram_, pictureProgram_, sunPictureProgram_, shadowProgram_;
  Texture sky_, cloudLight_, backdrop_, shadow_, patches_;
  Framebuffer cloudTarget_, backdropTarget_, shadowTarget_;
  Buffer drawBuffer_, shadowBuffer_;
  VertexArray shadowArray_, noArray_;
  PuffBrush brush_;
  Impostors impostors_;
  Volumes volumes_;
  struct Run {
    std::uint32_t first = 0, count = 0;
    enum Kind { Puffs, Picture, Volume } kind = Puffs;
  };
  std::vector<DrawPuff> list_, shadows_;
  std::vector<Run> runs_;
  struct Size {
    int width = 0, height = 0;
  };
  /// Of all that can be drawn, of what is drawn now, and of the clouds and the backdrop of that.
  Size most_, picture_, cloudSize_, backdropSize_;
  std::array<float, 4> shadowBox_{};
  float shadowCell_ = 1, skyHeight_ = 0;
  bool isNew_ = true, isShadowOld_ = true, isSkyOld_ = true;
};

}  // namespace cloudgen::runtime::gles
