// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::check {

/// A mesh of triangles with a blended picture, as columns.
struct PictureMesh {
  std::vector<float> points, places, colors;  ///< xyz; uv with v downwards; RGBA
  std::vector<float> opticalDepths;           ///< as stated (_OPTICAL_DEPTH); empty if they are not
  /// Of columns, as stated by the relief of a cloud (_VERTICAL_OPTICAL_DEPTH); empty if it is none. Triangles are
  /// a, b, c and a, c, d of a cell then.
  std::vector<float> verticalOpticalDepths;
  std::vector<std::uint32_t> triangles;       ///< vertices, three each
  bool doubleSided = false;
  std::string picture;  ///< the name of its image

  std::size_t vertices() const { return points.size() / 3; }
  glm::vec3 point(std::uint32_t vertex) const {
    return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
  }
};

/// Where a mesh is drawn.
struct MeshPlace {
  glm::vec3 shift{0};
  glm::mat3 axes{1};
};

/// A node that draws a mesh, once or, by EXT_mesh_gpu_instancing, many times.
struct MeshNode {
  std::vector<PictureMesh> parts;  ///< those of its primitives that have blended pictures
  std::vector<MeshPlace> places;
  std::string genus;  ///< of its extras; may be empty
};

/// Hands over the nodes of a GLB file that draw blended pictures; they stand in no other node and are placed by no matrix. Throws
/// InputError, naming `where`, if the file is something else or reaches outside its bounds. `seconds`: after the valid
/// time of a sky that moves.
void readPictureMeshes(std::string_view bytes, const std::string& where,
                       const std::function<void(const MeshNode&)>& visit, double seconds = 0);

}  // namespace cloudgen::check
