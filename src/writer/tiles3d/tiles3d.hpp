// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/format.hpp"

namespace cloudgen::writer {

/// Writes tileset.json and tiles/: 3D Tiles 1.1, a quadtree of binary glTF files of Gaussian splats or cards on
/// the WGS84 globe, each where the model has it; with cards textures/, too. Bounding volumes are regions; tiles refine by REPLACE; the
/// geometric error of a tile is the width of the widest puff in it that stands for others, that of leaves is 0.
/// Of a sky that moves it is a tileset a time of the forecast: the first as above, the others in hours/TIME/; the first
/// names all in asset.extras.times. Throws InputError if a texture is missing, OutputError if a file cannot be written.
void writeTiles(const scene::Scene& scene, const Destination& destination);

}  // namespace cloudgen::writer
