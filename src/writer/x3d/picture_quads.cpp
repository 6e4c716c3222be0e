// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/picture_quads.hpp"

namespace cloudgen::writer {

void appendQuads(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first,
                 const glm::vec3& place, float scale, const glm::vec3& tint, QuadMesh& mesh,
                 Outline outline) {
  constexpr int kCells = 10;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const PuffPicture& picture = pictures[i].picture;
    const Sight& sight = pictures[i].sight;
    const glm::vec2 size(picture.image.width, picture.image.height),
        step = (picture.upper - picture.lower) / size;
    const std::vector<glm::ivec4> whole{{0, 0, picture.image.width, picture.image.height}};
    for (const glm::ivec4& patch : outline == Outline::Tight ? patchesOf(picture.image, kCells) : whole) {
      const glm::vec2 low = picture.lower + step * glm::vec2(patch.x, picture.image.height - patch.w),
                      high = picture.lower + step * glm::vec2(patch.z, picture.image.height - patch.y),
                      middle = 0.5f * (low + high), half = 0.5f * scale * (high - low);
      const glm::vec3 center = middle.x * sight.right + middle.y * sight.up + picture.surface * sight.towards;
      mesh.faces.push_back(static_cast<std::uint32_t>(2 * mesh.quads.size()));
      mesh.quads.push_back({place + scale * center, half.x * sight.right, half.y * sight.up,
                            atlas.textureBox(first + i, patch), glm::vec4(tint, 1), 0});
    }
  }
}

}  // namespace cloudgen::writer
