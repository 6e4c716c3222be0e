// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/glb_parts.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr int kByte = 5121, kShort = 5123, kInteger = 5125, kFloat = 5126;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t unsignedAt(const char* bytes, std::size_t width) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, width);
  return value;
}

/// Bytes of a component; 0 of a type that is not read.
std::size_t widthOf(const json& componentType) {
  if (componentType == kByte) return 1;
  if (componentType == kShort) return 2;
  return componentType == kInteger || componentType == kFloat ? 4 : 0;
}

}  // namespace

GlbParts::GlbParts(std::string_view bytes, std::string where, std::string hint)
    : where_(std::move(where)), hint_(std::move(hint)), root_(std::make_unique<json>()) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes || bytes.compare(0, 4, "glTF") != 0)
    fail("is not a GLB file");
  const std::size_t jsonBytes = unsignedAt(bytes.data() + kHeaderBytes, 4),
                    binaryStart = kHeaderBytes + 2 * kChunkHeaderBytes + jsonBytes;
  if (jsonBytes > bytes.size() - kHeaderBytes - kChunkHeaderBytes) fail("is cut short in its JSON chunk");
  try {
    *root_ = json::parse(bytes.substr(kHeaderBytes + kChunkHeaderBytes, jsonBytes));
  } catch (const json::exception& error) {
    fail(std::string("has a broken JSON chunk (") + error.what() + ")");
  }
  if (binaryStart > bytes.size()) return;
  const std::size_t binaryBytes = unsignedAt(bytes.data() + binaryStart - kChunkHeaderBytes, 4);
  if (binaryBytes > bytes.size() - binaryStart) fail("is cut short in its binary chunk");
  binary_ = bytes.substr(binaryStart, binaryBytes);
}

GlbParts::~GlbParts() = default;

void GlbParts::fail(const std::string& what) const { throw base::InputError(where_, what, hint_); }

std::string_view GlbParts::bytesOf(const json& accessor, std::size_t components, std::size_t width) const {
  const json& view = root_->at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const auto count = accessor.at("count").get<std::size_t>();
  const auto offset = accessor.value("byteOffset", std::size_t{0}),
             start = view.value("byteOffset", std::size_t{0}) + offset;
  if (width == 0 || view.contains("byteStride")) fail("has attributes that are not plain numbers");
  if (start < offset || count > binary_.size() / width / components || start > binary_.size() ||
      count * components * width > binary_.size() - start)
    fail("has an accessor outside its binary chunk");
  return binary_.substr(start, count * components * width);
}

std::string_view GlbParts::view(std::size_t index) const {
  const json& view = root_->at("bufferViews").at(index);
  const auto start = view.value("byteOffset", std::size_t{0}), length = view.at("byteLength").get<std::size_t>();
  if (start > binary_.size() || length > binary_.size() - start)
    fail("has a buffer view outside its binary chunk");
  return binary_.substr(start, length);
}

std::vector<float> GlbParts::floats(std::size_t accessorIndex, std::size_t components) const {
  const json& accessor = root_->at("accessors").at(accessorIndex);
  const json& type = accessor.at("componentType");
  const bool unit = (type == kByte || type == kShort) && accessor.value("normalized", false);
  if (type != kFloat && !unit) fail("has attributes that are not plain numbers");
  const std::size_t width = widthOf(type);
  const std::string_view bytes = bytesOf(accessor, components, width);
  std::vector<float> values(bytes.size() / width);
  if (values.empty()) return values;
  if (!unit) {
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  const float whole = type == kByte ? 255 : 65535;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(unsignedAt(bytes.data() + i * width, width)) / whole;
  return values;
}

std::vector<std::uint32_t> GlbParts::indices(std::size_t accessorIndex) const {
  const json& accessor = root_->at("accessors").at(accessorIndex);
  const json& type = accessor.at("componentType");
  if (type == kFloat) fail("has indices that are not integers");
  const std::size_t width = widthOf(type);
  const std::string_view bytes = bytesOf(accessor, 1, width);
  std::vector<std::uint32_t> values(width ? bytes.size() / width : 0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = unsignedAt(bytes.data() + i * width, width);
  return values;
}

}  // namespace cloudgen::check
