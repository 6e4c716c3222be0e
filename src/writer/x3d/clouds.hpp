// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/progress.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Clouds that viewers that cannot tell how near a tile is have at hand, about.
inline constexpr std::size_t kClockedClouds = 1200;

/// Writes the clouds of a scene as tiles. Far off each is a few Shapes, its clouds as cards with their
/// pictures. Near it is a file of its own (scene.tile_NAME.x3d in `folder`) with tiles within it, or with the
/// clouds themselves, which viewers load as they come near.
void writeTiles(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                const std::filesystem::path& folder, const base::Progress& progress);

/// Writes all clouds into the one file, for VRML97: a Group a tile, without levels of detail.
void writeTileGroups(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                     const base::Progress& progress);

}  // namespace cloudgen::writer
