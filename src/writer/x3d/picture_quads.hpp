// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/pictures/cloud_pictures.hpp"
#include "writer/pictures/picture_atlas.hpp"
#include "writer/x3d/quads.hpp"

namespace cloudgen::writer {

enum class Outline : unsigned char { Whole, Tight };

/// Adds the quads of pictures, `first` being the place of their first one in the atlas; moved and scaled,
/// their colours multiplied by `tint`; one a picture, or tight ones around what is seen. Their faces are not
/// in order yet: orderFaces, level ones first.
void appendQuads(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first,
                 const glm::vec3& place, float scale, const glm::vec3& tint, QuadMesh& mesh, Outline outline);

}  // namespace cloudgen::writer
