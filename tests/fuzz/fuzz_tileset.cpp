// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: validating a tileset ends with findings. Up to the first NUL they are tileset.json, what follows is
// every content.
#include <cstdint>
#include <string_view>

#include "check/tiles3d/validate_tileset.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find('\0');
  const std::string_view content = end == bytes.npos ? std::string_view() : bytes.substr(end + 1);
  cloudgen::check::validateTilesetBytes(bytes.substr(0, end), "tileset.json",
                                        [&](const std::string&) { return std::string(content); });
  return 0;
}
