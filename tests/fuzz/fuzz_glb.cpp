// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: validation ends, with findings or without.
#include <cstdint>
#include <string_view>

#include "check/gltf/validate_glb.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cloudgen::check::validateGlbBytes({reinterpret_cast<const char*>(data), size}, "fuzz.glb");
  return 0;
}
