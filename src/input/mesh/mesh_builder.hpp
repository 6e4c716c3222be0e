// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/mesh.hpp"

namespace cloudgen::input::mesh {

/// A mesh while it is read: whatever a file says is checked before it is taken. All calls throw InputError
/// that names `where`.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string named) : where(std::move(named)) {}

  std::string where;  ///< of what is read now: file, and line or part

  /// Finite numbers only, none over 1e12.
  void addPoint(const glm::dvec3& point);
  /// Corners counted from 0; a polygon of n corners becomes n - 2 triangles.
  void addPolygon(std::span<const std::int64_t> corners);
  std::size_t points() const { return mesh_.points.size(); }
  /// Throws if there is no triangle.
  base::Mesh finished();

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  base::Mesh mesh_;
};

}  // namespace cloudgen::input::mesh
