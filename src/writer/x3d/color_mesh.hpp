// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "writer/pictures/cloud_pictures.hpp"
#include "writer/pictures/picture_mesh.hpp"
#include "writer/x3d/node_writer.hpp"

namespace cloudgen::writer {

/// Triangles with a colour at each corner, drawn without light or texture.
struct ColorMesh {
  std::vector<glm::vec3> points;
  std::vector<glm::vec4> colors;  ///< sRGB code values and opacity, 0..1
  std::vector<std::int32_t> indices;
  bool mayHide = true;  ///< what is opaque hides what is behind; not where pictures lie in one plane
};

/// Adds a picture as triangles where it stands, given from `origin`.
void appendMesh(const CloudPicture& picture, const PictureMesh& flat, const glm::vec3& origin, ColorMesh& mesh);

/// Declares what the Shapes of a file look like, before the first of them: an UnlitMaterial, as the first
/// node of a prototype is what it stands for. X3DOM 1.8 does not know that node and takes the Material behind
/// it, which it sorts by distance; as no light is on there are the same colours.
void declareUnlit(NodeWriter& nodes);

/// Writes a Shape, its colours multiplied by `tint`; none for no triangle. Not for VRML97.
void writeMesh(NodeWriter& nodes, const ColorMesh& mesh, const glm::vec3& tint);

/// Writes it as a Billboard about every axis, its middle at `center`.
void writeTurning(NodeWriter& nodes, const glm::vec3& center, const ColorMesh& mesh, const glm::vec3& tint);

}  // namespace cloudgen::writer
