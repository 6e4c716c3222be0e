// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cloudgen::base {

/// True if the name of a file ends in one of the extensions (".ply"), in letters of either case.
bool hasExtension(const std::filesystem::path& file, std::span<const std::string_view> extensions);
inline bool hasExtension(const std::filesystem::path& file, std::string_view extension) {
  return hasExtension(file, std::span(&extension, 1));
}

/// The bytes of a regular file. Throws InputError if it is missing, a folder, unreadable or over
/// `limitBytes`.
std::string readFile(const std::filesystem::path& file, std::uint64_t limitBytes = std::uint64_t{1} << 32);

/// Writes the bytes beside the file and renames, so that the file is whole or absent. Throws OutputError.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// The same for a file made of pieces, one after another, so that a large file need not stand in memory
/// twice.
void writeFile(const std::filesystem::path& file, std::span<const std::string_view> pieces);

/// An output folder that appears under its name only when it is complete: files go to a hidden folder
/// beside it, commit() renames. Without commit() nothing is left behind.
class StagedFolder {
 public:
  /// Throws OutputError if `target` exists and is not empty (unless `overwrite`), if its parent does not
  /// exist or cannot be written. With `overwrite` only a folder that holds a report.json of ours is replaced.
  StagedFolder(std::filesystem::path target, bool overwrite);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  void commit();

 private:
  std::filesystem::path target_, staging_;
  bool overwrite_;
};

}  // namespace cloudgen::base
