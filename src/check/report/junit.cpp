// SPDX-License-Identifier: Apache-2.0
#include "check/report/report.hpp"

namespace cloudgen::check {
namespace {

/// The length of the UTF-8 character at the front that XML 1.0 allows, or 0.
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 || byte(0) == '\n' || byte(0) == '\t' ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool noCharacter = (byte(0) == 0xed && byte(1) >= 0xa0) || (byte(0) == 0xf4 && byte(1) >= 0x90) ||
                           (byte(0) == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe);
  return overlong || noCharacter ? 0 : length;
}

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = characterLength(text);
    const char c = text.front();
    if (length == 0)
      out += "\xef\xbf\xbd";  // the replacement character
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\n' || c == '\t')
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

/// The findings of one severity, a line each; `first` becomes the first of them.
std::string listed(const CheckedFile& file, Severity severity, const Finding*& first) {
  std::string lines;
  for (const Finding& finding : file.result.findings) {
    if (finding.severity != severity) continue;
    if (!first) first = &finding;
    lines += escaped(text(finding)) + "\n";
  }
  return lines;
}

std::string testCase(const CheckedFile& file) {
  const std::string name = escaped(file.file);
  std::string out =
      fmt::format("    <testcase classname=\"cloudgen.validate\" name=\"{0}\" file=\"{0}\">\n", name);
  const Finding* error = nullptr;
  const Finding* warning = nullptr;
  const std::string errors = listed(file, Severity::Error, error),
                    warnings = listed(file, Severity::Warning, warning);
  const std::string_view tag = file.unreadable ? "error" : "failure";
  if (error)
    out += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", tag, escaped(error->rule),
                       escaped(error->message), errors);
  if (warning) out += fmt::format("      <system-out>{}</system-out>\n", warnings);
  return out + "    </testcase>\n";
}

}  // namespace

std::string junitReport(std::span<const CheckedFile> files) {
  std::size_t unreadable = 0;
  for (const CheckedFile& file : files) unreadable += file.unreadable ? 1 : 0;
  const std::string counts = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", files.size(),
                                         totalsOf(files).invalid - unreadable, unreadable);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite name=\"cloudgen validate\" "
      "{0}>\n",
      counts);
  for (const CheckedFile& file : files) out += testCase(file);
  return out + "  </testsuite>\n</testsuites>\n";
}

}  // namespace cloudgen::check
