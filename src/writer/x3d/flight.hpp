// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "writer/x3d/node_writer.hpp"

namespace cloudgen::writer {

/// Writes a Viewpoint that flies from place to place (metres, scene frame) at one speed, looking ahead, each time that
/// it is chosen (X3DOM 1.8, which tells nobody of that, stays at the first place). Nothing if the places are fewer than
/// two, or all the same.
void writeFlight(NodeWriter& nodes, const std::vector<glm::vec3>& places);

}  // namespace cloudgen::writer
