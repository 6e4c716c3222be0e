// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

namespace cloudgen::check::test {

inline void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}
inline void appendWord(std::string& bytes, std::uint32_t word) { append(bytes, &word, 4); }

/// A binary glTF file of its two chunks.
inline std::string container(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  appendWord(bytes, 2);
  appendWord(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  appendWord(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  appendWord(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

/// A GLB in the making: numbers become an accessor each.
struct MadeGlb {
  nlohmann::json document;
  std::string binary;

  template <class Values>
  std::size_t column(const Values& values, const char* shape, std::size_t components) {
    using Value = std::decay_t<decltype(values[0])>;
    const int type = std::is_same_v<Value, float> ? 5126 : sizeof(Value) == 2 ? 5123 : 5125;
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(Value)}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", type},
                                     {"count", values.size() / components},
                                     {"normalized", type == 5123},
                                     {"type", shape}});
    append(binary, values.data(), values.size() * sizeof(Value));
    return document["accessors"].size() - 1;
  }
  std::string bytes() const { return container(document.dump(), binary); }
};

}  // namespace cloudgen::check::test
