// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "base/progress.hpp"
#include "check/gltf/read_meshes.hpp"
#include "check/gltf/read_splats.hpp"

namespace cloudgen::check {

/// A splat on the globe: Earth-fixed coordinates, metres.
struct GlobeSplat {
  glm::dvec3 center{0};
  glm::dmat3 halfAxes{1};  ///< columns of one deviation each
  float opacity = 0, opticalDepth = 0;
};

/// Nodes of blended pictures, and the way from their axes (x east, y up, z south) to Earth-fixed coordinates.
using VisitMesh = std::function<void(const MeshNode&, const glm::dmat4& toEarth)>;

/// Hands over the splats (and cards, if somebody wants them) of a tileset as a viewer near by draws them: those of the tiles that have no
/// children, and of tiles that add to their parents. Contents are binary glTF, gzip or not, below the folder
/// of the tileset. Throws InputError where it is something else, InterruptedError on cancel.
void readTiles(const std::filesystem::path& file, const base::Progress& progress,
               const std::function<void(const GlobeSplat&)>& visit, const VisitMesh& visitMesh = {});

}  // namespace cloudgen::check
