// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace cloudgen::check {

/// Bytes in order, from a file or from memory, a chunk at a time.
class ByteSource {
 public:
  /// Throws InputError if the file is missing, not a regular file or unreadable.
  explicit ByteSource(const std::filesystem::path& file);
  /// The bytes must outlive the source.
  explicit ByteSource(std::string_view bytes) : memory_(bytes), size_(bytes.size()) {}

  /// The next chunk; empty at the end. Valid until the next call.
  std::string_view next();
  std::uint64_t size() const { return size_; }

 private:
  std::ifstream stream_;
  std::vector<char> buffer_;
  std::string_view memory_;
  std::uint64_t size_ = 0;
};

}  // namespace cloudgen::check
