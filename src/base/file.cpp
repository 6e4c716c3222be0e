// SPDX-License-Identifier: Apache-2.0
#include "base/file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"
#include "base/growing_file.hpp"
#include "base/text.hpp"

namespace cloudgen::base {
namespace fs = std::filesystem;

namespace {

std::string systemReason() { return std::strerror(errno); }

fs::path absoluteWithoutTrailingSlash(const fs::path& path) {
  fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

}  // namespace

bool hasExtension(const fs::path& file, std::span<const std::string_view> extensions) {
  const std::string own = file.extension().string();
  return std::ranges::any_of(extensions,
                             [&](std::string_view extension) { return equalIgnoringCase(own, extension); });
}

std::string readFile(const fs::path& file, std::uint64_t limitBytes) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(file.string(), "no such file", "check the path");
  if (!fs::is_regular_file(status))
    throw InputError(file.string(), "is not a regular file", "name a file, not a folder or a device");
  const auto size = fs::file_size(file, error);
  if (error) throw InputError(file.string(), error.message(), "check the permissions");
  if (size > limitBytes)
    throw InputError(file.string(), fmt::format("is {} bytes, over the limit of {}", size, limitBytes),
                     "is it the right file?");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw InputError(file.string(), "cannot be read (" + systemReason() + ")", "check the permissions");
  return bytes;
}

void writeFile(const fs::path& file, std::string_view bytes) { writeFile(file, std::span(&bytes, 1)); }

void writeFile(const fs::path& file, std::span<const std::string_view> pieces) {
  GrowingFile out(file);
  for (const std::string_view bytes : pieces) out.append(bytes);
  out.commit();
}

StagedFolder::StagedFolder(fs::path target, bool overwrite)
    : target_(absoluteWithoutTrailingSlash(target)), overwrite_(overwrite) {
  const fs::path parent = target_.parent_path();
  if (!fs::is_directory(parent))
    throw OutputError(parent.string(), "no such folder to write into", "make it first, or choose another -o");
  if (fs::exists(target_)) {
    if (!fs::is_directory(target_))
      throw OutputError(target_.string(), "exists and is not a folder", "choose another -o");
    if (!fs::is_empty(target_)) {
      if (!overwrite_)
        throw OutputError(target_.string(), "exists already",
                          "choose another -o, or add --overwrite to replace it");
      if (!fs::exists(target_ / "report.json"))
        throw OutputError(target_.string(), "is not a folder made by cloudgen (it has no report.json)",
                          "choose another -o: --overwrite replaces only our own output");
    }
  }
  staging_ = parent / ("." + target_.filename().string() + ".part-" + std::to_string(::getpid()));
  std::error_code error;
  fs::remove_all(staging_, error);
  if (!fs::create_directory(staging_, error))
    throw OutputError(parent.string(), "cannot be written (" + error.message() + ")",
                      "check its permissions, or choose another -o");
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void StagedFolder::commit() {
  std::error_code error;
  const fs::path old = staging_.string() + ".old";
  if (fs::exists(target_)) {
    fs::rename(target_, old, error);
    if (error)
      throw OutputError(target_.string(), "cannot be replaced (" + error.message() + ")",
                        "check its permissions");
  }
  fs::rename(staging_, target_, error);
  if (error) {
    std::error_code ignored;
    if (fs::exists(old)) fs::rename(old, target_, ignored);
    throw OutputError(target_.string(), "cannot be put in place (" + error.message() + ")",
                      "check its permissions");
  }
  fs::remove_all(old, error);
}

}  // namespace cloudgen::base
