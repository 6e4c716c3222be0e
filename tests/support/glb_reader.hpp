// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace cloudgen::test {

/// A folder that is gone when the test is over.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "cloudgen-test-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no scratch folder");
    path_ = pattern;
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A GLB taken apart by the letter of the specification; throws where the container is wrong.
struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    const auto need = [](bool good, const char* what) {
      if (!good) throw std::runtime_error(what);
    };
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    need(bytes.size() >= 20 && bytes.substr(0, 4) == "glTF" && word(4) == 2, "header");
    need(word(8) == bytes.size() && bytes.size() % 4 == 0, "total length");
    const std::uint32_t jsonLength = word(12);
    need(jsonLength % 4 == 0 && bytes.substr(16, 4) == "JSON", "JSON chunk");
    json = nlohmann::json::parse(bytes.substr(20, jsonLength));
    if (20 + jsonLength == bytes.size()) return;
    const std::uint32_t binaryLength = word(20 + jsonLength);
    need(binaryLength % 4 == 0 && bytes.substr(24 + jsonLength, 4) == std::string("BIN\0", 4),
         "binary chunk");
    need(28 + jsonLength + binaryLength == bytes.size(), "binary length");
    binary = bytes.substr(28 + jsonLength);
    const std::size_t declared = json.at("buffers").at(0).at("byteLength");
    need(binary.size() >= declared && binary.size() - declared < 4, "buffer padding");
    need(binary.find_first_not_of('\0', declared) == std::string::npos, "padding is not zero");
  }

  /// The values of an accessor; integers that stand for 0..1 come as such.
  std::vector<float> values(int index) const {
    const auto& accessor = json.at("accessors").at(index);
    const auto& view = json.at("bufferViews").at(accessor.at("bufferView").get<int>());
    const std::map<std::string, int> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t count = accessor.at("count").get<std::size_t>() * widths.at(accessor.at("type"));
    const int type = accessor.at("componentType");
    const std::size_t width = type == 5121 ? 1 : type == 5123 ? 2 : 4, offset = view.value("byteOffset", 0u);
    if (offset % 4 != 0 || count * width != view.at("byteLength") || offset + count * width > binary.size())
      throw std::runtime_error("buffer view");
    std::vector<float> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const char* at = binary.data() + offset + i * width;
      if (type == 5126) std::memcpy(&out[i], at, 4);
      std::uint32_t integer = 0;
      std::memcpy(&integer, at, width);
      if (type == 5125) out[i] = static_cast<float>(integer);
      if (type == 5123) out[i] = static_cast<float>(integer) / 65535;
      if (type == 5121) out[i] = static_cast<float>(integer) / 255;
    }
    return out;
  }
};

}  // namespace cloudgen::test
