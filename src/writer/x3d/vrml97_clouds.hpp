// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/progress.hpp"
#include "writer/x3d/quad_shape.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Writes the clouds of a scene for VRML97, all into the one file, without levels of detail: view3dscene 4.2
/// shows nothing of a LOD in such a file (it wants X3D's `children` there instead of VRML97's own `level`).
/// The clouds about where the viewpoints look are a Transform each, with its record, around one textured picture that
/// turns to the viewer; the others stand as crossed pictures, or wide squares of them as one from above, in a Shape a tile.
void writeVrml97Clouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                       const std::filesystem::path& folder, const base::Progress& progress);

}  // namespace cloudgen::writer
