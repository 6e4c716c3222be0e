// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/glb_parts.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr int kSignedByte = 5120, kByte = 5121, kSignedShort = 5122, kShort = 5123, kInteger = 5125, kFloat = 5126;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t unsignedAt(const char* bytes, std::size_t width) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, width);
  return value;
}

int signedAt(const char* bytes, std::size_t width) {
  const auto value = static_cast<int>(unsignedAt(bytes, width)), sign = 1 << (8 * width - 1);
  return (value ^ sign) - sign;
}

/// Bytes of a component; 0 of a type that is not read.
std::size_t widthOf(const json& componentType) {
  if (componentType == kByte || componentType == kSignedByte) return 1;
  if (componentType == kShort || componentType == kSignedShort) return 2;
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

GlbParts::Tuples GlbParts::tuplesOf(const json& accessor, std::size_t components, std::size_t width) const {
  const json& view = root_->at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const auto count = accessor.at("count").get<std::size_t>();
  const auto offset = accessor.value("byteOffset", std::size_t{0}),
             start = view.value("byteOffset", std::size_t{0}) + offset;
  const std::size_t size = components * width, stride = view.value("byteStride", size);
  if (width == 0 || stride < size) fail("has attributes that are not plain numbers");
  if (start < offset || start > binary_.size() ||
      (count > 0 && (count - 1 > (binary_.size() - start) / stride ||
                     size > binary_.size() - start - (count - 1) * stride)))
    fail("has an accessor outside its binary chunk");
  return {binary_.data() + start, count, stride};
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
  if (type == kInteger) fail("has attributes that are not plain numbers");
  const std::size_t width = widthOf(type);
  const Tuples tuples = tuplesOf(accessor, components, width);
  const bool isSigned = type == kSignedByte || type == kSignedShort, normalized = accessor.value("normalized", false);
  const float whole = !normalized ? 1 : static_cast<float>((1u << (8 * width - (isSigned ? 1 : 0))) - 1);
  std::vector<float> values;
  values.reserve(tuples.count * components);
  for (std::size_t i = 0; i < tuples.count; ++i)
    for (std::size_t k = 0; k < components; ++k) {
      const char* at = tuples.first + i * tuples.stride + k * width;
      float value = 0;
      if (type == kFloat)
        std::memcpy(&value, at, width);
      else if (isSigned)
        value = std::max(-whole, static_cast<float>(signedAt(at, width))) / whole;
      else
        value = static_cast<float>(unsignedAt(at, width)) / whole;
      values.push_back(value);
    }
  return values;
}

std::vector<std::uint32_t> GlbParts::indices(std::size_t accessorIndex) const {
  const json& accessor = root_->at("accessors").at(accessorIndex);
  const json& type = accessor.at("componentType");
  if (type != kByte && type != kShort && type != kInteger) fail("has indices that are not integers");
  const std::size_t width = widthOf(type);
  const Tuples tuples = tuplesOf(accessor, 1, width);
  std::vector<std::uint32_t> values(tuples.count);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = unsignedAt(tuples.first + i * tuples.stride, width);
  return values;
}

}  // namespace cloudgen::check
