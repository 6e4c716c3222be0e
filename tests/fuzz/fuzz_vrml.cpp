// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: validation ends, with findings or without.
#include <cstdint>
#include <string_view>

#include "check/vrml/validate_vrml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cloudgen::check::validateVrmlText({reinterpret_cast<const char*>(data), size}, "fuzz.vrml");
  return 0;
}
