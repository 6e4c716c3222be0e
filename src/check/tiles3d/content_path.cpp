// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/content_path.hpp"

#include <charconv>
#include <filesystem>

namespace cloudgen::check {

std::string contentPath(std::string_view uri) {
  std::string path;
  uri = uri.substr(0, uri.find_first_of("?#"));
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = uri.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 2 || error != std::errc() || end != digits.data() + 2) return {};
    path += static_cast<char>(value);
    i += 2;
  }
  if (path.find_first_of(std::string_view(":\\\0", 3)) != path.npos) return {};
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  if (normal.empty() || normal.is_absolute() || !normal.has_filename() || *normal.begin() == ".." || normal == ".")
    return {};
  return normal.generic_string();
}

}  // namespace cloudgen::check
