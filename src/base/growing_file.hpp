// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace cloudgen::base {

/// A file that is written piece by piece and appears under its name only when it is whole: bytes go beside
/// it, commit() renames. Without commit() nothing is left behind. Everything throws OutputError.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path file);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Appends the bytes as they are; nothing is kept back in memory.
  void append(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_, beside_;
  int descriptor_ = -1;
};

}  // namespace cloudgen::base
