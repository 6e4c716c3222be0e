// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: reading splats ends with splats or with an InputError.
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "check/gltf/read_splats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    cloudgen::check::readSplats(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.glb");
  } catch (const cloudgen::base::InputError&) {
  }
  return 0;
}
