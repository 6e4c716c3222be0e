// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "base/file.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/gltf/read_splats.hpp"
#include "check/ply/read_ply.hpp"

namespace cloudgen::check {
namespace {

Blob blobOf(const ReadSplat& splat) {
  glm::mat3 halfAxes = glm::mat3_cast(glm::normalize(splat.rotation));
  for (int axis = 0; axis < 3; ++axis) halfAxes[axis] *= splat.sigma[axis];
  return volumeBlob(splat.center, halfAxes, splat.opticalDepth);
}

}  // namespace

WrittenScene readSplatScene(const std::filesystem::path& file) {
  WrittenScene scene = readSplatScene(base::readFile(file), file.string());
  scene.file = file.filename().string();
  return scene;
}

WrittenScene readSplatScene(std::string_view bytes, const std::string& where) {
  constexpr float kMostTold = 16.6f;  // by the last float before 1
  WrittenScene scene{where, "splats", {}, {}, {}, 0};
  readSplats(bytes, where, [&](const ReadSplat& splat) {
    if (splat.opacity >= 1 && splat.opticalDepth <= kMostTold) ++scene.saturated;
    scene.blobs.push_back(blobOf(splat));
  });
  return scene;
}

WrittenScene readPlyScene(const std::filesystem::path& file) {
  WrittenScene scene{file.filename().string(), "ply", {}, {}, {}, 0};
  readPlySplats(base::readFile(file, std::uint64_t{1} << 36), file.string(),
                [&](const ReadSplat& splat) { scene.blobs.push_back(blobOf(splat)); });
  return scene;
}

}  // namespace cloudgen::check
