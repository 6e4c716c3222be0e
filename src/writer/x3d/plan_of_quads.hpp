// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "shape/plan.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// Quads as a viewer straight above sees them.
class PlanOfQuads {
 public:
  /// A raster around the quads of puffs.
  explicit PlanOfQuads(std::span<const shape::Puff> puffs);

  /// Those that stand still; upright ones are seen edge-on.
  void add(const QuadMesh& mesh);
  /// Those of a Billboard with its origin at `origin`, which has turned to the viewer: up is north.
  void addTurning(const QuadMesh& mesh, const glm::vec3& origin);
  /// Puffs as blended blobs: shape::widenedAcross.
  void addBlended(std::span<const shape::Puff> puffs, float covering);
  /// The mean of what has more than shape::kCoveringOpticalDepth and what has enough to cover where it meets a
  /// neighbour, m2.
  double coveredSquareMeters() const;

 private:
  void add(const Quad& quad, const glm::vec2& place, const glm::vec2& right, const glm::vec2& up);

  shape::PlanRaster raster_;
};

}  // namespace cloudgen::writer
