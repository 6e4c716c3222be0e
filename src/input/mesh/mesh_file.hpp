// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "base/mesh.hpp"

namespace cloudgen::input {

/// True for names that end in .obj, .ply, .off, .gltf or .glb.
bool isMeshFile(const std::filesystem::path& file);

/// Reads all triangles of a mesh file; polygons become fans. Throws InputError (where: file and line, or
/// part): damaged, without triangles, more than mesh::kMostTriangles of them.
base::Mesh readMesh(const std::filesystem::path& file);

namespace mesh {

inline constexpr std::size_t kMostTriangles = 2'000'000;

/// The formats, each from its bytes; `where` names the file in messages.
base::Mesh readObj(std::string_view text, const std::string& where);
base::Mesh readOff(std::string_view text, const std::string& where);
base::Mesh readPly(std::string_view bytes, const std::string& where);
/// The scene of a glTF 2.0 file, nodes placed. External buffers are read from `folder` itself, never from
/// elsewhere; an empty `folder` has none.
base::Mesh readGltf(std::string_view bytes, const std::string& where, const std::filesystem::path& folder);

}  // namespace mesh
}  // namespace cloudgen::input
