// SPDX-License-Identifier: Apache-2.0
#include "input/mesh/mesh_file.hpp"

#include <array>

#include "base/error.hpp"
#include "base/file.hpp"

namespace cloudgen::input {
namespace {

constexpr std::uint64_t kLimitBytes = 512ull << 20;
constexpr std::array<std::string_view, 5> kExtensions{".obj", ".ply", ".off", ".gltf", ".glb"};

}  // namespace

bool isMeshFile(const std::filesystem::path& file) { return base::hasExtension(file, kExtensions); }

base::Mesh readMesh(const std::filesystem::path& file) {
  const std::string bytes = base::readFile(file, kLimitBytes), where = file.string();
  if (base::hasExtension(file, ".obj")) return mesh::readObj(bytes, where);
  if (base::hasExtension(file, ".off")) return mesh::readOff(bytes, where);
  if (base::hasExtension(file, ".ply")) return mesh::readPly(bytes, where);
  return mesh::readGltf(bytes, where, file.parent_path().empty() ? "." : file.parent_path());
}

}  // namespace cloudgen::input
