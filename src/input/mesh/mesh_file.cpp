// SPDX-License-Identifier: Apache-2.0
#include "input/mesh/mesh_file.hpp"

#include <array>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace cloudgen::input {
namespace {

constexpr std::uint64_t kLimitBytes = 512ull << 20;
constexpr std::array<std::string_view, 5> kEndings{".obj", ".ply", ".off", ".gltf", ".glb"};

bool endsIn(const std::filesystem::path& file, std::string_view ending) {
  return base::equalIgnoringCase(file.extension().string(), ending);
}

}  // namespace

bool isMeshFile(const std::filesystem::path& file) {
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](std::string_view ending) { return endsIn(file, ending); });
}

base::Mesh readMesh(const std::filesystem::path& file) {
  const std::string bytes = base::readFile(file, kLimitBytes), where = file.string();
  if (endsIn(file, ".obj")) return mesh::readObj(bytes, where);
  if (endsIn(file, ".off")) return mesh::readOff(bytes, where);
  if (endsIn(file, ".ply")) return mesh::readPly(bytes, where);
  return mesh::readGltf(bytes, where, file.parent_path().empty() ? "." : file.parent_path());
}

}  // namespace cloudgen::input
