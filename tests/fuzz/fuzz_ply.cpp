// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: checking and reading splats in PLY ends with findings, splats or an InputError.
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "check/ply/read_ply.hpp"
#include "check/ply/validate_ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  cloudgen::check::validatePlyBytes(bytes, "fuzz.ply");
  try {
    cloudgen::check::readPlySplats(bytes, "fuzz.ply", [](const cloudgen::check::ReadSplat&) {});
  } catch (const cloudgen::base::InputError&) {
  }
  return 0;
}
