// SPDX-License-Identifier: Apache-2.0
#include "runtime/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

namespace cloudgen::runtime {

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

Status MappedFile::open(const char* path) noexcept {
  close();
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return {"the file cannot be opened"};
  struct stat info {};
  Status status;
  if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size <= 0) {
    status = {"the file is empty, or no regular file"};
  } else {
    void* const at = mmap(nullptr, static_cast<std::size_t>(info.st_size), PROT_READ, MAP_PRIVATE, file, 0);
    if (at == MAP_FAILED) {
      status = {"the file cannot be mapped into memory"};
    } else {
      data_ = static_cast<const std::uint8_t*>(at);
      size_ = static_cast<std::size_t>(info.st_size);
    }
  }
  ::close(file);
  return status;
}

void MappedFile::close() noexcept {
  if (data_) munmap(const_cast<std::uint8_t*>(data_), size_);
  data_ = nullptr;
  size_ = 0;
}

}  // namespace cloudgen::runtime
