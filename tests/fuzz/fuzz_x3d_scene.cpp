// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: reading the clouds of an X3D scene ends with blobs or with an InputError, and they
// can be looked at.
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "check/fidelity/imager.hpp"
#include "check/fidelity/written_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  for (const double seconds : {0.0, 1800.0}) try {
    const auto scene =
        check::readX3dScene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.x3d", seconds);
    const glm::dvec2 rays[]{{0, 0}, {10, -20}, {1e6, 1e6}};
    for (const double zenith : {0.0, 60.0}) {
      const auto footprints =
          check::footprintsOf(scene.blobs, scene.pivots, check::viewFrom(zenith, 180, 1000));
      check::Imager(footprints).look(rays, {});
    }
  } catch (const base::InputError&) {
  }
  return 0;
}
