// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "check/report/report.hpp"

namespace cloudgen::check {
namespace {

/// The findings of one severity, a line each; `first` becomes the first of them.
std::string listed(const CheckedFile& file, Severity severity, const Finding*& first) {
  std::string lines;
  for (const Finding& finding : file.result.findings) {
    if (finding.severity != severity) continue;
    if (!first) first = &finding;
    lines += base::xmlEscaped(text(finding)) + "\n";
  }
  return lines;
}

std::string testCase(const CheckedFile& file) {
  const std::string name = base::xmlEscaped(file.file);
  std::string out =
      fmt::format("    <testcase classname=\"cloudgen.validate\" name=\"{0}\" file=\"{0}\">\n", name);
  const Finding* error = nullptr;
  const Finding* warning = nullptr;
  const std::string errors = listed(file, Severity::Error, error),
                    warnings = listed(file, Severity::Warning, warning);
  const std::string_view tag = file.unreadable ? "error" : "failure";
  if (error)
    out += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", tag,
                       base::xmlEscaped(error->rule), base::xmlEscaped(error->message), errors);
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
