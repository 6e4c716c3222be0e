// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "scene/scene.hpp"
#include "writer/x3d/color_mesh.hpp"

namespace cloudgen::writer {

/// How fine the picture of a cloud is.
enum class MeshFineness : unsigned char { Fine, Middle, Coarse };

/// Archetypes as one picture each: what lies level, or one that turns to the viewer about its middle. It is
/// painted under one heading, and shows the viewer the same side under every other.
class CloudMeshes {
 public:
  explicit CloudMeshes(const scene::Scene& scene);

  /// Writes one as it is under a share of the sun, in its own metres.
  void write(NodeWriter& nodes, std::uint32_t archetype, float sunlight, MeshFineness fineness) const;

  /// How far away, in metres of the archetype, its picture of a fineness does as well as a finer one.
  float beginningOf(std::uint32_t archetype, MeshFineness fineness) const {
    return wholes_[archetype].beginnings[static_cast<std::size_t>(fineness)];
  }

 private:
  struct Whole {
    std::uint32_t lit = 0;  ///< what it is painted of
    bool turns = false;
    glm::vec3 middle{0};
    std::array<ColorMesh, 3> meshes;         ///< by MeshFineness
    std::array<float, 3> beginnings{0, 0, 0};  ///< the same
  };
  const scene::Scene& scene_;
  std::vector<Whole> wholes_;  ///< by archetype
};

}  // namespace cloudgen::writer
