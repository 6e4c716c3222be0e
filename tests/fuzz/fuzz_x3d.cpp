// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: X3D validation ends, within bounds, with findings or without.
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "check/xsd/validate_x3d.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const cloudgen::check::XmlSchema schema(std::filesystem::path(CLOUDGEN_SOURCE_DIR) / "schemas" /
                                                 "cloudgen-x3d.xsd");
  cloudgen::check::validateX3dText({reinterpret_cast<const char*>(data), size}, "fuzz.x3d", schema);
  return 0;
}
