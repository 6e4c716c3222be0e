// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/progress.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Clouds that become nodes of their own at most; of more, the widest do, the others are drawn as the cards
/// of their tile.
inline constexpr std::size_t kMostCloudNodes = 1200;

/// Writes one LOD a tile: near its clouds, far one Shape a genus of crossed cards. A cloud is a Transform
/// (with its record as metadata) around the LOD of its lit archetype, which the first cloud that needs it
/// defines and the others use.
void writeClouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                 const base::Progress& progress);

}  // namespace cloudgen::writer
