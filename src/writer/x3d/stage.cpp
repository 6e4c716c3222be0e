// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/stage.hpp"

#include <glm/common.hpp>

#include "writer/film/film.hpp"

namespace cloudgen::writer {
namespace {

float widthOf(const scene::Scene& scene, const scene::Instance& instance) {
  const scene::Archetype& archetype = scene.archetypes[scene.lit[instance.lit].archetype];
  const glm::vec3 size = archetype.bounds.upper - archetype.bounds.lower;
  return instance.scale * std::max({size.x, size.z, 1.0f});
}

}  // namespace

float tileSide(const Stage& stage) { return std::max({stage.extent / 7.99f, 2 * stage.cloudWidth, 1000.0f}); }

Stage stageOf(const scene::Scene& scene) {
  Stage stage;
  const glm::dvec2 low = scene.frame.lowerCorner(), high = scene.frame.upperCorner();
  stage.lower = glm::vec3(low.x, scene.groundHeightMeters, low.y);
  stage.upper = glm::vec3(high.x, scene.groundHeightMeters + 1000.0f, high.y);
  double widths = 0, squares = 0;
  for (const scene::Instance& instance : scene.instances) {
    const scene::Archetype& archetype = scene.archetypes[scene.lit[instance.lit].archetype];
    stage.lower = glm::min(stage.lower, instance.position);
    stage.upper =
        glm::max(stage.upper, instance.position + glm::vec3(0, archetype.bounds.upper.y * instance.scale, 0));
    const double width = widthOf(scene, instance);
    widths += width;
    squares += width * width;
  }
  stage.extent = std::max(stage.upper.x - stage.lower.x, stage.upper.z - stage.lower.z);
  stage.cloudWidth = widths > 0 ? static_cast<float>(squares / widths) : stage.extent / 20;

  stage.focus = 0.5f * (stage.lower + stage.upper);
  stage.focusBase = stage.focusTop = stage.focus.y;
  double most = 0;
  const Film film(scene);
  for (const scene::Tile& tile : scene::tilesOf(scene, 0.5f * tileSide(stage))) {
    double cover = 0, base = 0;
    glm::dvec3 middle(0);
    float top = -1e30f;
    for (const std::uint32_t i : tile.instances) {
      if (!film.isThereAtFirst(i)) continue;
      const scene::Instance& instance = scene.instances[i];
      const shape::Bounds& box = scene.archetypes[scene.lit[instance.lit].archetype].bounds;
      const double weight = std::pow(widthOf(scene, instance), 2);
      cover += weight;
      base += weight * instance.position.y;
      middle += weight * glm::dvec3(instance.position + instance.scale * 0.5f * (box.lower + box.upper));
      top = std::max(top, instance.position.y + instance.scale * box.upper.y);
    }
    if (cover <= most) continue;
    most = cover;
    stage.focus = glm::vec3(middle / cover);
    stage.focusBase = static_cast<float>(base / cover);
    stage.focusTop = top;
  }
  return stage;
}

}  // namespace cloudgen::writer
