// SPDX-License-Identifier: Apache-2.0
#include "check/xsd/byte_source.hpp"

#include "base/error.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {
constexpr std::size_t kChunkBytes = 1 << 16;
}

ByteSource::ByteSource(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) throw base::InputError(file.string(), "no such file", "check the path");
  if (!fs::is_regular_file(status))
    throw base::InputError(file.string(), "is not a regular file", "name a file, not a folder or a device");
  size_ = fs::file_size(file, error);
  stream_.open(file, std::ios::binary);
  if (!stream_ || error) throw base::InputError(file.string(), "cannot be opened", "check the permissions");
  buffer_.resize(kChunkBytes);
}

std::string_view ByteSource::next() {
  if (buffer_.empty()) {
    const std::string_view chunk = memory_.substr(0, kChunkBytes);
    memory_.remove_prefix(chunk.size());
    return chunk;
  }
  stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  return {buffer_.data(), static_cast<std::size_t>(stream_.gcount())};
}

}  // namespace cloudgen::check
