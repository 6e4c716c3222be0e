// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/progress.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Puffs of clouds in full that stand in the scene's own file, about; those of the other tiles are in files
/// of their own. Fewer in a scene of few clouds, which has all the others there as one picture each.
inline constexpr std::size_t kPuffsAtHand = 4000, kPuffsAtHandOfFew = 300;
/// Puffs that are drawn in full in all files together, about: of more, the widest clouds are, the others are
/// their far puffs. It bounds what is written to some 150 MB.
inline constexpr std::size_t kPuffsInFull = 400000;

/// Writes the clouds of a scene, each a Transform with its record as metadata. Of few clouds each is one
/// picture that turns to the viewer, and in full in a file of its tile (scene.tile_NAME.x3d in `folder`),
/// which viewers load as they come near; the tiles about the places that the viewpoints look at stand in the
/// scene's file. Of many clouds a tile is pictures in one Shape until its file is loaded. Not for VRML97.
void writeClouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                 const std::filesystem::path& folder, const base::Progress& progress);

}  // namespace cloudgen::writer
