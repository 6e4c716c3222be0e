// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace cloudgen::writer {

/// What the tiles of a tileset hold.
enum class TileContent {
  Auto,    ///< Packed where CesiumJS draws them all, else Cards
  Packed,  ///< splats packed as SPZ: small, and what CesiumJS draws
  Cards,   ///< textured rectangles: what every viewer draws, and clouds of any size in CesiumJS
  Splats   ///< splats as plain columns: what three.js and Babylon.js draw
};

struct TilesOptions {
  TileContent content = TileContent::Auto;
  bool gzip = false;  ///< files are gzip under their own names; servers must say Content-Encoding: gzip
};

struct SplatOptions {
  int degree = 1;         ///< of the spherical harmonics, 0 to 2: how sharply clouds brighten towards the sun
  bool quantize = false;  ///< scene.splats.glb in shorts and bytes
};

struct CardOptions {
  bool singly = false;  ///< scene.glb has a node a cloud, for viewers without EXT_mesh_gpu_instancing
};

struct X3dOptions {
  bool onGlobe = false;  ///< scene.geo.x3d beside scene.x3d
};

/// Where a writer puts its files, and whom it tells how far it is.
struct Destination {
  std::filesystem::path folder;  ///< exists; files of other formats may already be in it
  base::Progress progress;
  /// What verify found in the files that are already there, as schemas/verify.schema.json says; empty if
  /// nobody looked. Its maps are in verify/.
  std::string verification = {};
  TilesOptions tiles = {};
  SplatOptions splats = {};
  CardOptions cards = {};
  X3dOptions x3d = {};
  std::vector<glm::dvec3> flight = {};  ///< places of a viewpoint that flies: degrees east, north, metres
};

/// One output format. `write` throws OutputError; it writes only the named files (and textures/).
struct Format {
  std::string_view name, description;
  std::vector<std::string_view> files;
  void (*write)(const scene::Scene&, const Destination&);
  bool onlyOnRequest = false;      ///< not among those that are written when none is named
  bool showsVerification = false;  ///< wants Destination::verification: written after the scene was verified
  /// Clouds of all times of a sky that moves that it holds with their motions, at most; with more it gets the scene of
  /// the first time.
  std::size_t mostMovingClouds = 0;

  bool moves(const scene::Scene& scene) const { return scene.instances.size() <= mostMovingClouds; }
};

}  // namespace cloudgen::writer
