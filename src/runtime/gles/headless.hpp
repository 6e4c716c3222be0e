// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <EGL/egl.h>

#include "runtime/status.hpp"

namespace cloudgen::runtime::gles {

/// An OpenGL ES 3.0 context without window or screen, current in the thread that opened it as long as this lives.
/// It draws into framebuffer objects only.
class HeadlessContext {
 public:
  HeadlessContext() = default;
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// Surfaceless where EGL can (Mesa, in software where there is no GPU), else with a surface of one pixel.
  Status open() noexcept;

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace cloudgen::runtime::gles
