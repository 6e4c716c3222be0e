// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/runtime.hpp"

namespace cloudgen::fly {

/// An S-shaped flight northwards at 250 m/s, 25 frames a second, that begins at a place.
struct Flight {
  runtime::Vec3 start;
  float bendMeters = 3500;

  runtime::Camera cameraAt(int frame, int width, int height) const;
};

/// Through the middle of a pack's clouds, a little over the lowest storey's.
Flight flightThrough(const runtime::PackView& pack);

/// Looks from one place to another, both of the scene.

runtime::Camera cameraBetween(const runtime::Vec3& eye, const runtime::Vec3& target, int width, int height);

}  // namespace cloudgen::fly
