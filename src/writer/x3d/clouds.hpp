// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/progress.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Puffs of clouds in full that stand in the scene's own file, about; those of the other tiles are in files
/// of their own.
inline constexpr std::size_t kPuffsAtHand = 12000;
/// Puffs that are drawn in full in all files together, about: of more, the widest clouds are, the others are
/// their far puffs. It bounds what is written to some 150 MB.
inline constexpr std::size_t kPuffsInFull = 400000;

/// Writes the clouds of a scene as tiles, one LOD each: far off one Shape a genus of crossed cards, near the
/// clouds, each a Transform with its record as metadata. What is near stands in the scene's file about the
/// places that the viewpoints look at; elsewhere in a file of the tile (scene.tile_NAME.x3d in `folder`),
/// which viewers load as they come near. VRML97 has all in the one file, without levels of detail.
void writeClouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                 const std::filesystem::path& folder, const base::Progress& progress);

}  // namespace cloudgen::writer
