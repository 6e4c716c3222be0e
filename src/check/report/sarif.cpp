// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <nlohmann/json.hpp>

#include "check/report/report.hpp"

namespace cloudgen::check {
namespace {

using Json = nlohmann::ordered_json;

/// A path as a relative or absolute URI (RFC 3986).
std::string uriOf(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string uri = path.starts_with("/") ? "file://" : "";
  if (path.starts_with("./")) path.remove_prefix(2);
  for (const char c : path) {
    const bool isPlain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         kPlain.find(c) != std::string_view::npos;
    uri += isPlain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

Json resultOf(const Finding& finding, std::size_t ruleIndex, const std::string& uri, std::size_t fileIndex) {
  Json place{{"artifactLocation", {{"uri", uri}, {"index", fileIndex}}}};
  if (finding.line > 0) place["region"] = {{"startLine", finding.line}, {"startColumn", finding.column}};
  return {{"ruleId", finding.rule},
          {"ruleIndex", ruleIndex},
          {"level", name(finding.severity)},
          {"message", {{"text", finding.message + " (" + finding.hint + ")"}}},
          {"locations", Json::array({{{"physicalLocation", std::move(place)}}})}};
}

/// "index-range": "index range".
std::string spoken(std::string rule) {
  for (char& c : rule)
    if (c == '-') c = ' ';
  return rule;
}

}  // namespace

std::string sarifReport(std::span<const CheckedFile> files, std::string_view version) {
  std::map<std::string, std::size_t> rules;
  for (const CheckedFile& file : files)
    for (const Finding& finding : file.result.findings) rules.emplace(finding.rule, 0);
  Json descriptions = Json::array(), artifacts = Json::array(), results = Json::array();
  for (auto& [rule, index] : rules) {
    index = descriptions.size();
    descriptions.push_back({{"id", rule}, {"shortDescription", {{"text", spoken(rule)}}}});
  }
  bool allRead = true;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string uri = uriOf(files[i].file);
    artifacts.push_back({{"location", {{"uri", uri}}}});
    allRead = allRead && !files[i].unreadable;
    for (const Finding& finding : files[i].result.findings)
      results.push_back(resultOf(finding, rules.at(finding.rule), uri, i));
  }
  const Json driver{{"name", "cloudgen validate"}, {"version", version}, {"rules", std::move(descriptions)}};
  const Json run{{"tool", {{"driver", driver}}},
                 {"invocations", Json::array({{{"executionSuccessful", allRead}}})},
                 {"artifacts", std::move(artifacts)},
                 {"results", std::move(results)}};
  const Json log{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                 {"version", "2.1.0"},
                 {"runs", Json::array({run})}};
  return log.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cloudgen::check
