// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check/catalogue.hpp"
#include "cli/command.hpp"

namespace cloudgen::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string schema;
  bool json = false;
};

/// Text of a scene that is no UTF-8 is replaced, not refused: it stands in messages.
std::string dumped(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json jsonOf(const std::string& file, const check::ValidationResult& result) {
  nlohmann::ordered_json entry{{"file", file},
                               {"valid", result.valid()},
                               {"elements", result.elements},
                               {"nodes", result.nodes},
                               {"bytes", result.bytes}};
  entry["findings"] = nlohmann::ordered_json::array();
  for (const check::Finding& finding : result.findings)
    entry["findings"].push_back({{"severity", check::name(finding.severity)},
                                 {"line", finding.line},
                                 {"column", finding.column},
                                 {"rule", finding.rule},
                                 {"message", finding.message},
                                 {"hint", finding.hint}});
  return entry;
}

std::string summary(std::size_t files, std::size_t invalid, std::size_t errors, std::size_t warnings) {
  const std::string counts = fmt::format("{} error{}, {} warning{}", errors, errors == 1 ? "" : "s", warnings,
                                         warnings == 1 ? "" : "s");
  return invalid == 0 ? fmt::format("{} of {} valid ({})", files, files, counts)
                      : fmt::format("{} of {} not valid ({})", invalid, files, counts);
}

/// A file that cannot be read is a finding too, so that the others are still checked; the first such failure
/// is kept.
check::ValidationResult validated(const std::string& file, const std::optional<std::filesystem::path>& schema,
                                  const base::Progress& progress, std::exception_ptr& unreadable) {
  try {
    return check::validateFile(file, schema, progress);
  } catch (const base::InputError& error) {
    if (!unreadable) unreadable = std::current_exception();
    check::ValidationResult result;
    result.findings.push_back(
        {check::Severity::Error, error.where(), 0, 0, "unreadable", error.problem(), error.hint()});
    return result;
  }
}

int run(const Options& options, const Terminal& terminal) {
  const std::optional<std::filesystem::path> schema =
      options.schema.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.schema);
  const base::Progress progress = terminal.progress();
  nlohmann::ordered_json report{{"files", nlohmann::ordered_json::array()}};
  std::size_t invalid = 0, errors = 0, warnings = 0;
  std::exception_ptr unreadable;
  for (const std::string& file : options.files) {
    const check::ValidationResult result = validated(file, schema, progress, unreadable);
    for (const check::Finding& finding : result.findings) {
      ++(finding.severity == check::Severity::Error ? errors : warnings);
      if (!options.json) print(check::text(finding));
    }
    invalid += result.valid() ? 0 : 1;
    if (options.json) report["files"].push_back(jsonOf(file, result));
  }
  progress.step("validate", 1);
  report["valid"] = invalid == 0;
  if (options.json)
    print(dumped(report));
  else if (!terminal.quiet)
    print(summary(options.files.size(), invalid, errors, warnings));
  if (unreadable) std::rethrow_exception(unreadable);
  return invalid == 0 ? 0 : static_cast<int>(base::Failure::Output);
}

}  // namespace

std::function<int()> setupValidate(CLI::App& app, const Terminal& terminal) {
  const auto options = std::make_shared<Options>();
  std::string kinds;
  for (const check::FileKind& kind : check::fileKinds())
    kinds += fmt::format("{}{}", kinds.empty() ? "" : ", ", kind.extension);
  app.add_option("FILE", options->files, "scenes to check: " + kinds)->required();
  app.add_option("--schema", options->schema,
                 "XML Schema for .x3d files, instead of cloudgen's own profile of X3D 4.0");
  app.add_flag("--json", options->json, "one JSON object on stdout");
  return [options, &terminal] { return run(*options, terminal); };
}

}  // namespace cloudgen::cli
