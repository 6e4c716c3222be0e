// SPDX-License-Identifier: Apache-2.0
#include "fly/flight.hpp"

#include <algorithm>
#include <vector>

namespace cloudgen::fly {
namespace {

constexpr float kMetersPerFrame = 250.0f / 25;

}  // namespace

runtime::Camera Flight::cameraAt(int frame, int width, int height) const {
  const float meters = kMetersPerFrame * static_cast<float>(frame), phase = meters / 9000, bend = 0.4f * std::sin(phase);
  runtime::Camera camera;
  camera.widthPixels = width;
  camera.heightPixels = height;
  camera.eye = {start.x + bendMeters * (1 - std::cos(phase)), start.y + 300 * std::sin(meters / 7000), start.z - meters};
  camera.forward = {std::sin(bend), -0.08f, -std::cos(bend)};
  return camera;
}

Flight flightThrough(const runtime::PackView& pack) {
  const auto& root = *pack.tiles().data();
  const runtime::Vec3 lower = runtime::vec3(root.lower()), upper = runtime::vec3(root.upper());
  std::vector<float> heights;
  for (const pack::Instance& cloud : pack.instances()) heights.push_back(cloud.position().y());
  std::sort(heights.begin(), heights.end());
  const float low = heights.empty() ? 1000 : heights[heights.size() / 4];
  return {{0.5f * (lower.x + upper.x), low + 1500, lower.z + 0.85f * (upper.z - lower.z)}, 3500};
}

runtime::Camera cameraBetween(const runtime::Vec3& eye, const runtime::Vec3& target, int width, int height) {
  runtime::Camera camera;
  camera.eye = eye;
  camera.forward = runtime::normalized(target - eye);
  if (std::abs(camera.forward.y) > 0.999f) camera.up = {0, 0, -1};
  camera.widthPixels = width;
  camera.heightPixels = height;
  return camera;
}

}  // namespace cloudgen::fly
