// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame.hpp"
#include "base/genus.hpp"
#include "base/progress.hpp"
#include "check/fidelity/footprint.hpp"

namespace cloudgen::check {

/// A cloud that a scene names: where its foot stands, what its record says and with whose sprites it is
/// drawn.
struct WrittenCloud {
  glm::vec3 foot{0};
  std::optional<base::Genus> recorded, drawn;
};

/// What a written file draws of clouds.
struct WrittenScene {
  std::string file, format;          ///< "scene.x3d", "x3d"
  std::vector<Blob> blobs;           ///< in the order of the file
  std::vector<Pivot> pivots;         ///< of those that turn to the viewer
  std::vector<WrittenCloud> clouds;  ///< none in formats that do not name them
  /// Blobs so dense that their opacity is that of any denser one: of their optical depth only a lower bound
  /// is written.
  std::uint64_t saturated = 0;
  double groundMeters = 0;  ///< where one stands to look up; the reader leaves it at the sea
};

/// Reads scene.splats.glb. A splat's opacity o stands for the optical depth -ln(1 - o) of its centre seen
/// along its shortest axis; rays meet the exact integrals of the Gaussian. Throws InputError as readSplats
/// does.
WrittenScene readSplatScene(const std::filesystem::path& file);

/// The same from bytes; `where` names them in messages.
WrittenScene readSplatScene(std::string_view bytes, const std::string& where);

/// Reads scene.splats.ply as readSplatScene does. Throws InputError as readPlySplats does.
WrittenScene readPlyScene(const std::filesystem::path& file);

/// Reads scene.cgpack: the puffs of the first level of every cloud that is there so many seconds after the
/// valid time, whose optical depths are written as such. Throws InputError where validatePack finds an error.
WrittenScene readPackScene(const std::filesystem::path& file, double seconds = 0);

/// The same from bytes; `where` names them in messages.
WrittenScene readPackScene(std::string_view bytes, const std::string& where, double seconds = 0);

/// Reads the finest tiles of a tileset and takes their splats from the globe to the map of the scene, as
/// readSplatScene does else. Throws InputError as readTiles does.
WrittenScene readTileScene(const std::filesystem::path& file, const base::LocalFrame& frame,
                           const base::Progress& progress);

/// Reads the clouds of scene.x3d as a viewer far off draws them, but near enough for the first level of every
/// LOD: cards (pairs of triangles with an RGBA colour and a sprite texture) whose sprite falls off as a
/// Gaussian of 1/2.2 of the half side and ends there, of optical depth -ln(1 - alpha); back faces are
/// not drawn. A Billboard faces the viewer, its y axis to where the viewer has up (north, from above). Shapes
/// without sprites are no clouds. Files that it inlines are read where they lie in its folder or below; a
/// Switch with an Inline shows that, as it does once a viewer is near.
/// Throws InputError where a file is no XML, or it is no such scene, or what it inlines is not there.
/// Of a sky that moves: so many seconds after its valid time.
WrittenScene readX3dScene(const std::filesystem::path& file, const base::Progress& progress, double seconds = 0);

/// The same from bytes, without what they inline; `where` names them in messages.
WrittenScene readX3dScene(std::string_view bytes, const std::string& where, double seconds = 0);

/// Reads the clouds of scene.glb: meshes whose material blends a picture named by a genus ("Cu"), drawn once
/// or, by EXT_mesh_gpu_instancing, once a cloud. Vertices that triangles join are a card with that sprite,
/// its opacity the mean of theirs (COLOR_0), its falling off and its optical depth as in X3D; or they are the relief
/// of a cloud, whose cells are cards of the optical depth that they state (_VERTICAL_OPTICAL_DEPTH). Each instance
/// is a cloud, its record the genus in the node's extras. Throws InputError where the file is something else.
/// Of a sky that moves: so many seconds after its valid time.
WrittenScene readGlbScene(const std::filesystem::path& file, double seconds = 0);

/// The same from bytes; `where` names them in messages.
WrittenScene readGlbScene(std::string_view bytes, const std::string& where, double seconds = 0);

}  // namespace cloudgen::check
