// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "scene/scene.hpp"
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {

/// Writes clouds of one file as nodes: a Transform with the cloud's record as metadata around its lit
/// archetype, which the first cloud that needs it defines and the others use.
class CloudNodes {
 public:
  CloudNodes(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene)
      : nodes_(nodes), shapes_(shapes), scene_(scene) {}

  /// A cloud in full, or as its far puffs.
  void cloud(std::uint32_t instance, bool full);

 private:
  void record(const scene::CloudRecord& cloud);
  void look(std::uint32_t lit, float sunlight, bool full, const std::string& name);

  NodeWriter& nodes_;
  QuadShapes& shapes_;
  const scene::Scene& scene_;
  std::set<std::string> defined_;
};

}  // namespace cloudgen::writer
