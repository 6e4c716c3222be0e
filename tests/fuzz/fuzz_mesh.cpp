// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are, as each of the formats: a mesh whose corners are all points, or an InputError.
#include <cmath>
#include <cstdint>
#include <functional>

#include "base/error.hpp"
#include "input/mesh/mesh_file.hpp"

namespace {

using namespace cloudgen;

void expectWhole(const std::function<base::Mesh()>& read) {
  try {
    const base::Mesh mesh = read();
    if (mesh.triangles.empty()) __builtin_trap();
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= mesh.points.size()) __builtin_trap();
    for (const glm::dvec3& point : mesh.points)
      if (!std::isfinite(point.x + point.y + point.z)) __builtin_trap();
  } catch (const base::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  using namespace input::mesh;
  if (bytes.starts_with("ply")) {
    expectWhole([&] { return readPly(bytes, "fuzz.ply"); });
  } else if (bytes.starts_with("glTF") || bytes.starts_with("{")) {
    expectWhole([&] { return readGltf(bytes, "fuzz.glb", {}); });
  } else {
    expectWhole([&] { return readOff(bytes, "fuzz.off"); });
    expectWhole([&] { return readObj(bytes, "fuzz.obj"); });
  }
  return 0;
}
