// SPDX-License-Identifier: Apache-2.0
#include "check/rules/node_record.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// The path of a relative reference (RFC 3986): query and fragment cut, %20 undone.
std::string pathOf(std::string_view url) {
  url = url.substr(0, url.find_first_of("?#"));
  std::string path;
  for (std::size_t i = 0; i < url.size(); ++i) {
    const bool escaped =
        url[i] == '%' && i + 2 < url.size() && hexDigit(url[i + 1]) >= 0 && hexDigit(url[i + 2]) >= 0;
    path += escaped ? static_cast<char>(hexDigit(url[i + 1]) * 16 + hexDigit(url[i + 2])) : url[i];
    if (escaped) i += 2;
  }
  return path;
}

bool hasScheme(std::string_view url) {
  const auto colon = url.find(':');
  return colon != url.npos && colon < url.find_first_of("/?#");
}

bool leavesFolder(const std::string& path) {
  const fs::path normal = fs::path(path).lexically_normal();
  return normal.is_absolute() || path.starts_with("\\") || (!normal.empty() && *normal.begin() == "..");
}

}  // namespace

void UrlRules::check(std::string_view value, Position where, FindingList& findings) {
  constexpr std::size_t kRemembered = 1000;
  if (sound_.contains(value)) return;
  std::vector<std::string> strings;
  splitStrings(value, strings);
  std::string absent;
  bool someThere = false, isOutside = false;
  for (const std::string& url : strings) {
    const std::string path = pathOf(url);
    if (url.starts_with("data:") || (path.empty() && url.starts_with('#'))) {
      someThere = true;
    } else if (hasScheme(url) || path.find('\0') != path.npos || leavesFolder(path)) {
      isOutside = true;
      findings.warning(where, "url-outside",
                       excerpt(url) + " lies outside of the scene's folder; it was not opened",
                       "put the file beside the scene and name it relatively");
    } else if (!folder_.empty()) {
      std::error_code error;
      if (fs::is_regular_file(folder_ / path, error))
        someThere = true;
      else if (absent.empty())
        absent = url;
    }
  }
  if (!someThere && !absent.empty())
    findings.error(where, "url-missing", "there is no file " + excerpt(absent) + " beside the scene",
                   "copy it there, or correct the url (upper and lower case count)");
  else if (!isOutside && value.size() < 1000 && sound_.size() < kRemembered)
    sound_.emplace(value);
}

}  // namespace cloudgen::check
