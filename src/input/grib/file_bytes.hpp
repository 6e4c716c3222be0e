// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace cloudgen::input::grib {

/// Random access to a file, a few kilobytes at a time: headers lie together, data between them are skipped.
class FileBytes {
 public:
  /// Throws InputError if the file cannot be read.
  explicit FileBytes(const std::filesystem::path& file);

  std::uint64_t size() const { return size_; }
  /// The bytes from `offset`; fewer than `length` at the end of the file.
  std::string read(std::uint64_t offset, std::uint64_t length);

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0, windowStart_ = 0;
  std::string window_;
};

}  // namespace cloudgen::input::grib
