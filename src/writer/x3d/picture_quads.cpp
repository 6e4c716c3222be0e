// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/picture_quads.hpp"

namespace cloudgen::writer {

void appendQuads(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first,
                 const glm::vec3& place, float scale, const glm::vec3& tint, QuadMesh& mesh) {
  for (const CloudPicture& one : pictures) {
    const auto& [picture, sight] = one;
    const glm::vec2 half = 0.5f * scale * (picture.upper - picture.lower);
    mesh.faces.push_back(static_cast<std::uint32_t>(2 * mesh.quads.size()));
    mesh.quads.push_back(
        {place + scale * middleOf(one), half.x * sight.right, half.y * sight.up,
         atlas.textureBox(first++, {0, 0, picture.image.width, picture.image.height}), glm::vec4(tint, 1), 0});
  }
}

}  // namespace cloudgen::writer
