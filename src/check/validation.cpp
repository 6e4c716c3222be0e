// SPDX-License-Identifier: Apache-2.0
#include "check/validation.hpp"

#include <algorithm>
#include <tuple>

namespace cloudgen::check {

std::string_view name(Severity severity) { return severity == Severity::Error ? "error" : "warning"; }

std::string text(const Finding& finding) {
  std::string place = finding.file;
  if (finding.line > 0) place += fmt::format(":{}:{}", finding.line, finding.column);
  return fmt::format("{}: {}[{}]: {} ({})", place, name(finding.severity), finding.rule, finding.message,
                     finding.hint);
}

bool ValidationResult::valid() const {
  return std::none_of(findings.begin(), findings.end(),
                      [](const Finding& finding) { return finding.severity == Severity::Error; });
}

void FindingList::add(Severity severity, Position where, std::string_view rule, std::string message,
                      std::string hint) {
  auto& findings = result_->findings;
  if (full()) return;
  findings.push_back(
      {severity, file_, where.line, where.column, std::string(rule), std::move(message), std::move(hint)});
  if (findings.size() + 1 < kLimit) return;
  findings.push_back({Severity::Error, file_, where.line, where.column, "too-many",
                      fmt::format("{} findings: the rest is not shown", kLimit), "mend these first"});
}

void FindingList::sort() {
  std::stable_sort(result_->findings.begin(), result_->findings.end(),
                   [](const Finding& a, const Finding& b) {
                     return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                   });
}

std::string excerpt(std::string_view piece) {
  constexpr std::size_t kLongest = 60;
  std::string out = "\"";
  for (const char character : piece.substr(0, kLongest))
    out += static_cast<unsigned char>(character) < 0x20 || character == 0x7f ? ' ' : character;
  // A character of several bytes is not cut in two.
  if (piece.size() > kLongest) {
    while (!out.empty() && (static_cast<unsigned char>(piece[out.size() - 1]) & 0xc0) == 0x80) out.pop_back();
    out += "...";
  }
  return out + "\"";
}

}  // namespace cloudgen::check
