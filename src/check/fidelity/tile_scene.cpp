// SPDX-License-Identifier: Apache-2.0
#include <glm/geometric.hpp>

#include "base/geocentric.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/tiles3d/read_tiles.hpp"

namespace cloudgen::check {

WrittenScene readTileScene(const std::filesystem::path& file, const base::LocalFrame& frame,
                           const base::Progress& progress) {
  constexpr double kStepMeters = 10;
  constexpr float kMostOpaque = 1 - 0.5f / 255;
  const float saturation = -std::log1p(-kMostOpaque);
  const base::Geocentric globe;
  const auto onMap = [&](const glm::dvec3& earth) {
    const glm::dvec3 place = globe.toGeographic(earth);
    return frame.toScene(place.x, place.y, place.z);
  };
  WrittenScene scene{file.filename().string(), "tiles", {}, {}, {}, 0};
  readTiles(file, progress, [&](const GlobeSplat& splat) {
    const glm::dvec3 center = onMap(splat.center);
    glm::mat3 halfAxes(0);
    for (int axis = 0; axis < 3; ++axis) {
      const double length = glm::length(splat.halfAxes[axis]);
      const glm::dvec3 step = splat.halfAxes[axis] * (kStepMeters / length);
      halfAxes[axis] = (onMap(splat.center + step) - center) * (length / kStepMeters);
    }
    if (splat.opacity >= kMostOpaque && splat.opticalDepth <= saturation) ++scene.saturated;
    scene.blobs.push_back(volumeBlob(center, halfAxes, splat.opticalDepth));
  });
  return scene;
}

}  // namespace cloudgen::check
