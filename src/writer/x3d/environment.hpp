// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/x3d/node_writer.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Title, source, times, frame and bounds of the scene, for the head of the file. Nothing that changes
/// between runs.
HeadEntries headOf(const scene::Scene& scene, const Stage& stage);

/// NavigationInfo and Background.
void writeSurroundings(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage);

/// All but the clouds: WorldInfo, NavigationInfo, Background, Viewpoints, sun, ground, lines of longitude and
/// latitude. `flight` are places that another Viewpoint flies along, in the scene frame; none with fewer than
/// two.
void writeEnvironment(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage,
                      const HeadEntries& head, const std::vector<glm::vec3>& flight);

}  // namespace cloudgen::writer
