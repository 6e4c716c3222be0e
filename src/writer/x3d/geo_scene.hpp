// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/scene.hpp"
#include "writer/x3d/stage.hpp"

namespace cloudgen::writer {

/// Writes scene.geo.x3d: the scene.x3d beside it on the globe (WGS84), as a plane that is tangent where the scene's frame
/// is, with GeoViewpoints in degrees. For viewers with X3D's Geospatial component. Throws OutputError.
void writeGeoScene(const scene::Scene& scene, const Stage& stage, const std::filesystem::path& folder);

}  // namespace cloudgen::writer
