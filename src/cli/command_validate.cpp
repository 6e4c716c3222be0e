// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/catalogue.hpp"
#include "check/report/report.hpp"
#include "check/scene_files.hpp"
#include "cli/command.hpp"

namespace cloudgen::cli {
namespace fs = std::filesystem;

namespace {

struct Options {
  std::vector<std::string> files;
  std::string schema, junit, sarif;
  bool json = false;
};

std::string summary(const check::Totals& totals) {
  const std::string counts =
      fmt::format("{} error{}, {} warning{}", totals.errors, totals.errors == 1 ? "" : "s", totals.warnings,
                  totals.warnings == 1 ? "" : "s");
  return totals.invalid == 0 ? fmt::format("{} of {} valid ({})", totals.files, totals.files, counts)
                             : fmt::format("{} of {} not valid ({})", totals.invalid, totals.files, counts);
}

/// A file that cannot be read is a finding too, so that the others are still checked; the first such failure
/// is kept.
check::CheckedFile checked(const fs::path& file, const check::ChosenSchema& schema,
                           const base::Progress& progress, std::exception_ptr& unreadable) {
  try {
    return {file.string(), check::validateFile(file, schema, progress)};
  } catch (const base::InputError& error) {
    if (!unreadable) unreadable = std::current_exception();
    check::ValidationResult result;
    result.findings.push_back(
        {check::Severity::Error, error.where(), 0, 0, "unreadable", error.problem(), error.hint()});
    return {file.string(), result, true};
  }
}

/// A report takes the place of an older one, but never that of what it reports on.
void refuseToOverwriteScene(const std::string& option, const std::string& report,
                            const std::vector<fs::path>& files) {
  std::error_code error;
  for (const fs::path& file : files)
    if (!report.empty() && fs::equivalent(report, file, error))
      throw base::UsageError(option + " " + report, "is one of the files to check",
                             "give the report a name of its own");
}

int run(const Options& options, const Terminal& terminal) {
  const base::Progress progress = terminal.progress();
  const std::vector<fs::path> files = check::sceneFiles(options.files);
  refuseToOverwriteScene("--junit", options.junit, files);
  refuseToOverwriteScene("--sarif", options.sarif, files);
  const check::ChosenSchema schema =
      options.schema.empty() ? check::ChosenSchema() : check::ChosenSchema(options.schema);
  if (!options.schema.empty()) schema.compiled();
  std::vector<check::CheckedFile> results;
  std::exception_ptr unreadable;
  for (const fs::path& file : files) {
    results.push_back(checked(file, schema, progress, unreadable));
    if (!options.json)
      for (const check::Finding& finding : results.back().result.findings) print(check::text(finding));
  }
  progress.step("validate", 1);
  const check::Totals totals = check::totalsOf(results);
  if (options.json)
    print(check::jsonReport(results));
  else if (!terminal.quiet)
    print(summary(totals));
  if (!options.junit.empty()) base::writeFile(options.junit, check::junitReport(results));
  if (!options.sarif.empty()) base::writeFile(options.sarif, check::sarifReport(results, CLOUDGEN_VERSION));
  if (unreadable) std::rethrow_exception(unreadable);
  return totals.invalid == 0 ? 0 : static_cast<int>(base::Failure::Output);
}

}  // namespace

std::function<int()> setupValidate(CLI::App& app, const Terminal& terminal) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->files,
                 "scenes to check (" + check::knownEndings() +
                     "), folders of them, or quoted patterns such as 'scenes/**/*.x3d'")
      ->required();
  app.add_option("--schema", options->schema,
                 "XML Schema for .x3d files, instead of cloudgen's own profile of X3D 4.0");
  app.add_flag("--json", options->json, "one JSON object on stdout");
  app.add_option("--junit", options->junit, "also a JUnit report, for CI servers");
  app.add_option("--sarif", options->sarif, "also a SARIF log, for code hosts");
  return [options, &terminal] { return run(*options, terminal); };
}

}  // namespace cloudgen::cli
