// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/cloud_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace cloudgen::writer::gltf {
namespace {

void append(CloudMesh& mesh, const CloudPicture& one, const Relief& relief, const glm::vec4& box) {
  const auto& [picture, sight] = one;
  const auto first = static_cast<std::uint32_t>(mesh.opticalDepths.size());
  const float held = std::abs(sight.towards.y) > 0.5f ? 0.5f : 0;
  for (int row = 0; row <= relief.rows; ++row)
    for (int column = 0; column <= relief.columns; ++column) {
      const float u = static_cast<float>(column) / static_cast<float>(relief.columns),
                  v = 1 - static_cast<float>(row) / static_cast<float>(relief.rows);
      const std::size_t vertex = relief.vertex(column, row);
      const glm::vec3 place = glm::mix(picture.lower.x, picture.upper.x, u) * sight.right +
                              glm::mix(picture.lower.y, picture.upper.y, v) * sight.up +
                              relief.nearness[vertex] * sight.towards;
      mesh.positions.insert(mesh.positions.end(), {place.x, place.y, place.z});
      for (const float coordinate : {glm::mix(box.x, box.z, u), 1 - glm::mix(box.y, box.w, v)})
        mesh.textureBoxes.push_back(static_cast<std::uint16_t>(std::lround(65535 * coordinate)));
      mesh.opticalDepths.push_back(held * relief.opticalDepth[vertex]);
    }
  for (const auto& [column, row] : relief.shown) {
    const auto corner = [&](int right, int down) {
      return first + static_cast<std::uint32_t>(relief.vertex(column + right, row + down));
    };
    mesh.indices.insert(mesh.indices.end(),
                        {corner(0, 1), corner(1, 1), corner(1, 0), corner(0, 1), corner(1, 0), corner(0, 0)});
  }
}

/// A relief of at most four cells a side, on some of its vertices. Flat pictures would be seen edge-on as lines.
Relief coarse(const Relief& from) {
  constexpr int kMostCells = 4;
  Relief out;
  out.columns = std::min(from.columns, kMostCells), out.rows = std::min(from.rows, kMostCells);
  for (int row = 0; row <= out.rows; ++row)
    for (int column = 0; column <= out.columns; ++column) {
      const std::size_t vertex = from.vertex(column * from.columns / out.columns, row * from.rows / out.rows);
      out.nearness.push_back(from.nearness[vertex]);
      out.opticalDepth.push_back(from.opticalDepth[vertex]);
    }
  for (const auto& [column, row] : from.shown) {
    const std::array cell{column * out.columns / from.columns, row * out.rows / from.rows};
    if (std::ranges::find(out.shown, cell) == out.shown.end()) out.shown.push_back(cell);
  }
  return out;
}

}  // namespace

CloudMesh meshOf(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first) {
  CloudMesh mesh;
  for (const CloudPicture& one : pictures)
    append(mesh, one, one.picture.relief,
           atlas.textureBox(first++, {0, 0, one.picture.image.width, one.picture.image.height}));
  return mesh;
}

CloudMesh farMeshOf(std::span<const CloudPicture> pictures, const PictureAtlas& atlas, std::size_t first) {
  CloudMesh mesh;
  for (const CloudPicture& one : pictures) {
    const glm::vec4 box = atlas.textureBox(first++, {0, 0, one.picture.image.width, one.picture.image.height});
    if (!one.picture.relief.shown.empty()) append(mesh, one, coarse(one.picture.relief), box);
  }
  return mesh;
}

int addCloudMesh(GlbFile& file, const std::string& name, const CloudMesh& mesh, int material) {
  Attributes attributes{{"POSITION", file.addFloats(3, mesh.positions, true)},
                        {"TEXCOORD_0", file.addUnitShorts(2, mesh.textureBoxes)},
                        {"_VERTICAL_OPTICAL_DEPTH", file.addFloats(1, mesh.opticalDepths)}};
  return file.addMesh(
      name,
      {.attributes = std::move(attributes), .indices = file.addIndices(mesh.indices), .material = material});
}

}  // namespace cloudgen::writer::gltf
