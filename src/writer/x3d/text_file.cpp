// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/text_file.hpp"

#include "base/error.hpp"

namespace cloudgen::writer {

TextFile::TextFile(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) throw base::OutputError(file_.string(), "cannot be made", "check the output folder");
}

void TextFile::drain() {
  if (buffer_.size() >= (size_t{1} << 20)) write();
}

void TextFile::close() {
  write();
  stream_.close();
  if (!stream_) throw base::OutputError(file_.string(), "cannot be written", "is the disk full?");
}

void TextFile::write() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  if (!stream_) throw base::OutputError(file_.string(), "cannot be written", "is the disk full?");
  buffer_.clear();
}

}  // namespace cloudgen::writer
