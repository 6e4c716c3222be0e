// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_meshes.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/thread.hpp"

namespace cloudgen::writer {
namespace {

constexpr int kPixels = 64;
constexpr std::array<std::size_t, 3> kTriangles{900, 400, 120};  ///< by Fineness
constexpr std::size_t kPartTriangles = 160;

/// A puff that is seen as a quad of a Billboard is, almost without thickness.
ColoredPuff puffOf(const Quad& quad) {
  constexpr float kThickness = 0.01f;
  const float width = glm::length(quad.right) / kSpriteReach, height = glm::length(quad.up) / kSpriteReach;
  ColoredPuff out;
  out.color = glm::vec3(quad.color);
  out.puff.center = quad.center;
  out.puff.sigma = {width, height, kThickness * std::min(width, height)};
  out.puff.rotation = glm::angleAxis(std::atan2(quad.right.y, quad.right.x), glm::vec3(0, 0, 1));
  out.puff.extinctionPerMeter =
      quad.opticalDepth / (std::sqrt(2 * std::numbers::pi_v<float>) * out.puff.sigma.z);
  return out;
}

}  // namespace

CloudMeshes::CloudMeshes(const scene::Scene& scene) : scene_(scene), wholes_(scene.archetypes.size()) {
  std::vector<std::uint32_t> lit;  // the first of each archetype
  std::vector<bool> isKnown(scene.archetypes.size(), false);
  for (std::uint32_t i = 0; i < scene.lit.size(); ++i) {
    if (isKnown[scene.lit[i].archetype]) continue;
    isKnown[scene.lit[i].archetype] = true;
    lit.push_back(i);
  }
  base::parallelFor(lit.size(), [&](std::size_t i) {
    const CloudPictures pictures = picturesOf(scene, lit[i], kPixels);
    Whole& whole = wholes_[scene.lit[lit[i]].archetype];
    whole.lit = lit[i];
    whole.turns = !pictures.turning.empty();
    if (whole.turns) whole.middle = middleOf(pictures.turning.front());
    for (std::size_t f = 0; f < kTriangles.size(); ++f)
      for (const CloudPicture& one : whole.turns ? pictures.turning : pictures.level)
        appendMesh(one, kTriangles[f], whole.middle, whole.meshes[f]);
  });
}

void CloudMeshes::write(NodeWriter& nodes, std::uint32_t archetype, float sunlight, Fineness fineness) const {
  const Whole& whole = wholes_[archetype];
  const ColorMesh& mesh = whole.meshes[static_cast<std::size_t>(fineness)];
  const glm::vec3 tint = tintOf(scene_, whole.lit, sunlight);
  if (whole.turns)
    writeTurning(nodes, whole.middle, mesh, tint);
  else
    writeMesh(nodes, mesh, tint);
}

ColorMesh pictureOf(const CloudPart& part) {
  std::vector<ColoredPuff> puffs;
  for (const Quad& quad : part.mesh.quads) puffs.push_back(puffOf(quad));
  const Sight sight;
  CloudPicture picture{paintedPuffs(puffs, sight, kPixels), sight};
  picture.picture.surface = 0;
  ColorMesh mesh;
  mesh.mayHide = false;
  appendMesh(picture, kPartTriangles, glm::vec3(0), mesh);
  return mesh;
}

}  // namespace cloudgen::writer
