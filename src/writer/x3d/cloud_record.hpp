// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.hpp"
#include "writer/x3d/node_writer.hpp"

namespace cloudgen::writer {

/// Writes what is known of a cloud into its open Transform: as metadata, or as WorldInfo in VRML97.
void writeRecord(NodeWriter& nodes, const scene::CloudRecord& cloud);

}  // namespace cloudgen::writer
