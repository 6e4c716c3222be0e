// SPDX-License-Identifier: Apache-2.0
#include "base/growing_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace cloudgen::base {

GrowingFile::GrowingFile(std::filesystem::path file)
    : file_(std::move(file)),
      beside_(file_.string() + ".part"),
      descriptor_(::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail("cannot be written");
}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;
  if (!beside_.empty()) std::filesystem::remove(beside_, ignored);
}

void GrowingFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ::ssize_t taken = ::write(descriptor_, bytes.data(), bytes.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) fail("cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(taken));
  }
}

void GrowingFile::commit() {
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be written");
  if (::rename(beside_.c_str(), file_.c_str()) != 0) fail("cannot be put in place");
  beside_.clear();
}

void GrowingFile::fail(const char* what) const {
  throw OutputError(file_.string(), fmt::format("{} ({})", what, std::strerror(errno)),
                    "check the folder, its permissions and the free space");
}

}  // namespace cloudgen::base
