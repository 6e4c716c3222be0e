// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/node_writer.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Writes the ground: a flat square that reaches half a scene further than the scene and fades there into the
/// colour of the horizon; where the scene has terrain, that in a hole of the square.
void writeGround(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage);

}  // namespace cloudgen::writer
