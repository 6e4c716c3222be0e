// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/validate_glb.hpp"

#include <bit>
#include <cstring>

#include "base/file.hpp"
#include "check/gltf/gltf_document.hpp"

namespace cloudgen::check {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::size_t kJsonLimitBytes = 64 << 20;

std::uint32_t word(std::string_view bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little, "glTF is little-endian");
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Chunks {
  std::string_view json, binary;
  bool hasBinary = false;
};

/// The chunks of the container; findings and an empty JSON if there is no way to read it.
Chunks splitChunks(std::string_view bytes, FindingList& findings) {
  if (bytes.size() < kHeaderBytes || word(bytes, 0) != kMagic) {
    findings.error({}, "glb-header", "the file does not start with \"glTF\"", "is it binary glTF?");
    return {};
  }
  if (word(bytes, 4) != 2)
    findings.error({}, "glb-header", fmt::format("the container has version {}", word(bytes, 4)),
                   "only glTF 2 is known");
  if (word(bytes, 8) != bytes.size())
    findings.error({}, "glb-header",
                   fmt::format("the header says {} bytes, the file has {}", word(bytes, 8), bytes.size()),
                   "was the file cut short?");
  Chunks chunks;
  for (std::size_t at = kHeaderBytes, count = 0; at < bytes.size(); ++count) {
    if (bytes.size() - at < kChunkHeaderBytes || word(bytes, at) > bytes.size() - at - kChunkHeaderBytes) {
      findings.error({}, "glb-chunk", fmt::format("chunk {} runs over the end of the file", count),
                     "was the file cut short?");
      return chunks;
    }
    const std::size_t length = word(bytes, at);
    const std::uint32_t type = word(bytes, at + 4);
    const std::string_view body = bytes.substr(at + kChunkHeaderBytes, length);
    if (length % 4 != 0)
      findings.error({}, "glb-chunk", fmt::format("chunk {} has {} bytes", count, length),
                     "pad chunks to a multiple of four");
    if ((count == 0) != (type == kJsonChunk))
      findings.error({}, "glb-chunk", fmt::format("chunk {} is of a wrong type", count),
                     "first JSON, then BIN");
    if (count == 0 && type == kJsonChunk) chunks.json = body;
    if (count == 1 && type == kBinaryChunk) chunks.binary = body, chunks.hasBinary = true;
    at += kChunkHeaderBytes + length;
  }
  if (chunks.json.empty()) findings.error({}, "glb-chunk", "there is no JSON chunk", "is it binary glTF?");
  return chunks;
}

}  // namespace

ValidationResult validateGlbBytes(std::string_view bytes, const std::string& name,
                                  const base::Progress& progress) {
  ValidationResult result;
  result.bytes = bytes.size();
  FindingList findings(name, result);
  const Chunks chunks = splitChunks(bytes, findings);
  if (chunks.json.empty()) return result;
  if (chunks.json.size() > kJsonLimitBytes) {
    findings.error({}, "gltf-json", fmt::format("the JSON has over {} bytes", kJsonLimitBytes),
                   "keep data in the binary chunk");
    return result;
  }
  checkGltfDocument(chunks.json, chunks.binary, chunks.hasBinary, findings, progress);
  return result;
}

ValidationResult validateGlb(const std::filesystem::path& file, const ChosenSchema&,
                             const base::Progress& progress) {
  return validateGlbBytes(base::readFile(file), file.string(), progress);
}

}  // namespace cloudgen::check
