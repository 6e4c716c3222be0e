// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "writer/gltf/glb_file.hpp"
#include "writer/pictures/lit_cloud.hpp"
#include "writer/pictures/picture_atlas.hpp"

namespace cloudgen::writer::gltf {

/// A cloud as the reliefs of pictures of itself, in its own metres under its heading. Triangles look where
/// their picture was seen from.
struct CloudMesh {
  std::vector<float> positions;             ///< xyz, metres
  std::vector<std::uint16_t> textureBoxes;  ///< uv, 65535 = 1, origin at the upper left
  /// What a column through the cloud meets at a vertex: half of its optical depth where it enters, in a
  /// picture from above, and half where it leaves; nothing in upright pictures.
  std::vector<float> opticalDepths;
  std::vector<std::uint32_t> indices;  ///< two triangles a cell: a, b, c and a, c, d of its corners
};

/// The mesh of pictures that are those of an atlas from `first` on.
CloudMesh meshOf(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first);

/// The same from afar: at most 32 triangles a picture.
CloudMesh farMeshOf(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first);

/// Adds the mesh, its optical depths as _VERTICAL_OPTICAL_DEPTH, as 8-bit opacities do not tell them.
int addCloudMesh(GlbFile& file, const std::string& name, const CloudMesh& mesh, int material);

}  // namespace cloudgen::writer::gltf
