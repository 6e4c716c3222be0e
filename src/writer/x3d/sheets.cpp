// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/sheets.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "writer/pictures/cloud_pictures.hpp"

namespace cloudgen::writer {
Sheet sheetOf(const scene::Scene& scene, std::span<const std::uint32_t> instances, int pixels) {
  std::vector<ColoredPuff> puffs;
  for (const std::uint32_t i : instances) appendColored(scene, scene.instances[i], kFromAbove, puffs);
  Sheet sheet;
  sheet.picture = paintedPuffs(puffs, kFromAbove, pixels);
  sheet.patches = patchesOf(sheet.picture.image, 16);
  return sheet;
}

QuadMesh meshOf(const Sheet& sheet, const PictureAtlas& atlas, std::size_t picture) {
  QuadMesh mesh;
  const PuffPicture& seen = sheet.picture;
  const glm::vec2 step = (seen.upper - seen.lower) / glm::vec2(seen.image.width, seen.image.height);
  for (const glm::ivec4& patch : sheet.patches) {
    const glm::vec2 low(patch.x, patch.y), high(patch.z, patch.w);
    const glm::vec2 middle = glm::vec2(seen.lower.x, -seen.upper.y) + 0.5f * step * (low + high),
                    half = 0.5f * step * (high - low);
    const auto quad = static_cast<std::uint32_t>(mesh.quads.size());
    mesh.faces.insert(mesh.faces.end(), {2 * quad, 2 * quad + 1});  // the front looks up
    mesh.quads.push_back({glm::vec3(middle.x, seen.surface, middle.y), glm::vec3(half.x, 0, 0),
                          glm::vec3(0, 0, -half.y), atlas.textureBox(picture, patch), glm::vec4(1), 0});
  }
  return mesh;
}

}  // namespace cloudgen::writer
