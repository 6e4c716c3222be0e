// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace cloudgen::writer {

/// A file that is written piece by piece: text is added to a buffer that goes to the disk a megabyte at a
/// time.
class TextFile {
 public:
  /// Throws OutputError if the file cannot be made.
  explicit TextFile(const std::filesystem::path& file);

  std::string& text() { return buffer_; }
  /// Hands the buffer to the disk once it has grown large. Throws OutputError.
  void drain();
  /// Writes what is left. Throws OutputError, for instance on a full disk.
  void close();

 private:
  void write();

  std::filesystem::path file_;
  std::ofstream stream_;
  std::string buffer_;
};

}  // namespace cloudgen::writer
