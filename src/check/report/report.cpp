// SPDX-License-Identifier: Apache-2.0
#include "check/report/report.hpp"

#include <nlohmann/json.hpp>

namespace cloudgen::check {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const Finding& finding) {
  return {{"severity", name(finding.severity)}, {"line", finding.line},
          {"column", finding.column},           {"rule", finding.rule},
          {"message", finding.message},         {"hint", finding.hint}};
}

}  // namespace

Totals totalsOf(std::span<const CheckedFile> files) {
  Totals totals;
  totals.files = files.size();
  for (const CheckedFile& file : files) {
    totals.invalid += file.result.valid() ? 0 : 1;
    for (const Finding& finding : file.result.findings)
      ++(finding.severity == Severity::Error ? totals.errors : totals.warnings);
  }
  return totals;
}

std::string jsonReport(std::span<const CheckedFile> files) {
  const Totals totals = totalsOf(files);
  Json report{{"files", Json::array()}};
  for (const CheckedFile& file : files) {
    Json entry{
        {"file", file.file},          {"valid", file.result.valid()}, {"elements", file.result.elements},
        {"nodes", file.result.nodes}, {"bytes", file.result.bytes},   {"findings", Json::array()}};
    for (const Finding& finding : file.result.findings) entry["findings"].push_back(jsonOf(finding));
    report["files"].push_back(std::move(entry));
  }
  report["valid"] = totals.invalid == 0;
  report["counts"] = {{"files", totals.files},
                      {"invalid", totals.invalid},
                      {"errors", totals.errors},
                      {"warnings", totals.warnings}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cloudgen::check
