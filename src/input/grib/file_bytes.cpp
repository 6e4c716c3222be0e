// SPDX-License-Identifier: Apache-2.0
#include "input/grib/file_bytes.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace cloudgen::input::grib {

FileBytes::FileBytes(const std::filesystem::path& file) {
  stream_.rdbuf()->pubsetbuf(nullptr, 0);
  stream_.open(file, std::ios::binary);
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (error || !stream_)
    throw base::InputError(file.string(), "cannot be read", "check the path and its permissions");
}

std::string FileBytes::read(std::uint64_t offset, std::uint64_t length) {
  constexpr std::uint64_t kWindow = 4096;
  if (offset >= size_) return {};
  length = std::min(length, size_ - offset);
  const bool inWindow = offset >= windowStart_ && offset + length <= windowStart_ + window_.size();
  if (!inWindow) {
    window_.resize(static_cast<std::size_t>(std::min(std::max(length, kWindow), size_ - offset)));
    windowStart_ = offset;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(window_.data(), static_cast<std::streamsize>(window_.size()));
    window_.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream_.gcount(), 0)));
  }
  return window_.substr(static_cast<std::size_t>(offset - windowStart_), static_cast<std::size_t>(length));
}

}  // namespace cloudgen::input::grib
