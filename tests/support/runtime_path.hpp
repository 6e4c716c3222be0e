// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/runtime.hpp"

/// Flights for the tests and benchmarks of the runtime.
namespace cloudgen::test {

/// An S-shaped flight at 250 m/s, 60 frames a second, over a square sky (x to the east, z from 0 to -side).
inline runtime::Camera flightCamera(int frame, float sideMeters) {
  const float meters = 250.0f / 60 * static_cast<float>(frame), bend = 0.4f * std::sin(meters / 9000);
  runtime::Camera camera;
  camera.eye = {0.3f * sideMeters + 3500 * (1 - std::cos(meters / 9000)), 2500 + 1200 * std::sin(meters / 7000),
                -0.25f * sideMeters - meters};
  camera.forward = {std::sin(bend), -0.05f, -std::cos(bend)};
  return camera;
}

}  // namespace cloudgen::test
