// SPDX-License-Identifier: Apache-2.0
#include <glm/geometric.hpp>

#include "base/geocentric.hpp"
#include "check/fidelity/picture_cards.hpp"
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
  }, [&](const MeshNode& node, const glm::dmat4& toEarth) {
    std::vector<Card> cards;
    for (const PictureMesh& part : node.parts) addCardsOf(part, cards);
    for (const MeshPlace& place : node.places)
      for (const Card& card : cards) {
        const glm::dvec3 earth(toEarth * glm::dvec4(place.shift + place.axes * card.center, 1));
        const glm::dvec3 center = onMap(earth);
        const auto along = [&](const glm::vec3& side) {
          const glm::dvec3 way = glm::dmat3(toEarth) * glm::dvec3(place.axes * side);
          const double length = glm::length(way);
          return glm::vec3((onMap(earth + way * (kStepMeters / length)) - center) * (length / kStepMeters));
        };
        Blob blob = cardBlob(center, along(card.right) / kCardReach, along(card.up) / kCardReach, card.opticalDepth);
        blob.front = card.front;
        blob.back = card.back;
        scene.blobs.push_back(blob);
      }
  });
  boundSaturated(scene, 1 - 0.5f / 65535);  // opacities of cards are whole shares of 65535
  return scene;
}

}  // namespace cloudgen::check
