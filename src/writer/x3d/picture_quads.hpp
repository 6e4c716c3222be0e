// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/pictures/cloud_pictures.hpp"
#include "writer/pictures/picture_atlas.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

/// Adds the quads of pictures, `first` being the place of their first one in the atlas; moved and scaled,
/// their colours multiplied by `tint`. Their faces are not in order yet: orderFaces, level ones first.
void appendQuads(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first,
                 const glm::vec3& place, float scale, const glm::vec3& tint, QuadMesh& mesh);

}  // namespace cloudgen::writer
