// SPDX-License-Identifier: Apache-2.0
#include "input/mesh/mesh_builder.hpp"

#include "base/error.hpp"
#include "input/mesh/mesh_file.hpp"

namespace cloudgen::input::mesh {

void MeshBuilder::refuse(const std::string& problem) const {
  throw base::InputError(where, problem, "export the mesh again, as triangles");
}

void MeshBuilder::addPoint(const glm::dvec3& point) {
  constexpr double kMost = 1e12;
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(point[i]) <= kMost)) refuse("has a point that is not finite or too far away");
  if (mesh_.points.size() >= 3 * kMostTriangles)
    refuse(fmt::format("has more than {} points", 3 * kMostTriangles));
  mesh_.points.push_back(point);
}

void MeshBuilder::addPolygon(std::span<const std::int64_t> corners) {
  if (corners.size() < 3) refuse("has a face of fewer than three corners");
  for (const std::int64_t corner : corners)
    if (corner < 0 || corner >= static_cast<std::int64_t>(mesh_.points.size()))
      refuse(fmt::format("has a face with a corner that is none of its {} points", mesh_.points.size()));
  if (mesh_.triangles.size() + corners.size() > kMostTriangles)
    throw base::InputError(where, fmt::format("has more than {} triangles", kMostTriangles),
                           "simplify the mesh; a cloud shows a few thousand");
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh_.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                               static_cast<std::uint32_t>(corners[i - 1]),
                               static_cast<std::uint32_t>(corners[i])});
}

base::Mesh MeshBuilder::finished() {
  if (mesh_.triangles.empty()) refuse("has no triangle");
  return std::move(mesh_);
}

}  // namespace cloudgen::input::mesh
