// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "check/fidelity/written_scene.hpp"
#include "check/gltf/read_splats.hpp"

namespace cloudgen::check {
namespace {

WrittenScene sceneOf(const SplatFile& file, const std::string& name) {
  constexpr float kMostOpaque = 1 - 0x1p-24f;  // the last float before 1
  WrittenScene scene{name, "splats", {}, {}, {}, 0};
  scene.blobs.reserve(file.splats.size());
  for (const ReadSplat& splat : file.splats) {
    glm::mat3 halfAxes = glm::mat3_cast(glm::normalize(splat.rotation));
    for (int axis = 0; axis < 3; ++axis) halfAxes[axis] *= splat.sigma[axis];
    if (splat.opacity >= kMostOpaque) ++scene.saturated;
    const float depth = -std::log1p(-std::min(splat.opacity, kMostOpaque));
    scene.blobs.push_back(volumeBlob(splat.center, halfAxes, depth));
  }
  return scene;
}

}  // namespace

WrittenScene readSplatScene(const std::filesystem::path& file) {
  return sceneOf(readSplats(file), file.filename().string());
}

WrittenScene readSplatScene(std::string_view bytes, const std::string& where) {
  return sceneOf(readSplats(bytes, where), where);
}

}  // namespace cloudgen::check
