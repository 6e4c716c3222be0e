// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/status.hpp"

namespace cloudgen::runtime {

/// A file that is mapped into memory for reading, as long as this lives. Whoever changes the file meanwhile changes
/// what is read: replace packs by renaming.
class MappedFile {
 public:
  MappedFile() = default;
  ~MappedFile() { close(); }
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;

  Status open(const char* path) noexcept;
  void close() noexcept;
  std::span<const std::uint8_t> bytes() const noexcept { return {data_, size_}; }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace cloudgen::runtime
