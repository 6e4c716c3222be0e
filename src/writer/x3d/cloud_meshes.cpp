// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/cloud_meshes.hpp"

#include <algorithm>

#include "base/thread.hpp"

namespace cloudgen::writer {
namespace {

constexpr int kPixels = 128;
constexpr std::array<std::size_t, 3> kTriangles{120, 400, 1000};  ///< from coarse to fine
/// A coarser picture may miss the finest by so many pixels of a window that is 720 pixels high, X3D's usual field of view
/// of 45 degrees high.
constexpr float kMostPixels = 0.8f, kPixelsPerRadian = 869;

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
    const NearPictures near = nearPicturesOf(scene, lit[i], kPixels);
    Whole& whole = wholes_[scene.lit[lit[i]].archetype];
    whole.lit = lit[i];
    whole.turns = near.turns;
    if (whole.turns) whole.middle = middleOf(near.pictures.front());
    // Flat ones lie in one plane with others: what is hidden would be chance.
    for (ColorMesh& mesh : whole.meshes) mesh.mayHide = whole.turns;
    for (const CloudPicture& one : near.pictures) {
      const std::vector<PictureMesh> flat = meshesOf(one.picture, kTriangles);
      for (std::size_t f = 0; f < flat.size(); ++f) {
        const std::size_t fineness = flat.size() - 1 - f;
        appendMesh(one, flat[f], whole.middle, whole.meshes[fineness]);
        whole.beginnings[fineness] =
            std::max(whole.beginnings[fineness], flat[f].missMeters * kPixelsPerRadian / kMostPixels);
      }
    }
  });
}

void CloudMeshes::write(NodeWriter& nodes, std::uint32_t archetype, float sunlight, MeshFineness fineness) const {
  const Whole& whole = wholes_[archetype];
  const ColorMesh& mesh = whole.meshes[static_cast<std::size_t>(fineness)];
  const glm::vec3 tint = tintOf(scene_, whole.lit, sunlight);
  if (whole.turns)
    writeTurning(nodes, whole.middle, mesh, tint);
  else
    writeMesh(nodes, mesh, tint);
}

}  // namespace cloudgen::writer
