// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "writer/catalogue.hpp"

namespace {

using namespace cloudgen;

int fail(const base::Error& error) {
  fmt::print(stderr, "cloudgen: {}: {}\n  {}\n", error.where(), error.problem(), error.hint());
  return static_cast<int>(error.failure());
}

std::string usage() {
  std::string text =
      "cloudgen compiles what a weather model says about clouds into a 3D sky.\n\nusage: cloudgen COMMAND "
      "[OPTIONS]\n\n";
  for (const auto& command : cli::commands())
    text += fmt::format("  {:<10} {}\n", command.name, command.summary);
  return text + "\n`cloudgen COMMAND --help` tells more.";
}

void printVersion(bool asJson) {
  if (!asJson) return cli::print("cloudgen " CLOUDGEN_VERSION);
  nlohmann::ordered_json version{{"name", "cloudgen"}, {"version", CLOUDGEN_VERSION}};
  for (const auto& format : writer::formats()) version["formats"].push_back(format.name);
  for (const auto& [name, what] : writer::formatsNotBuilt()) version["formats_not_built"].push_back(name);
  version["commands_not_built"] = {"merge"};
  version["options_not_built"] = {"--shard", "--max-memory", "--frame geo", "--x3d-profile xite"};
  cli::print(version.dump(2));
}

/// The long option on the line that no command knows, if that is what went wrong.
int usageFailure(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  std::vector<std::string> known;
  if (command == &app)
    for (const auto& entry : cli::commands()) known.emplace_back(entry.name);
  for (const CLI::Option* option : command->get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  std::string hint = command == &app ? "see `cloudgen --help`"
                                     : fmt::format("see `cloudgen {} --help`", command->get_name());
  for (const std::string& word : command->remaining(true)) {
    const std::string nearest = base::nearestWord(word.substr(0, word.find('=')), known);
    if (!nearest.empty()) hint = fmt::format("did you mean {}?", nearest);
  }
  return fail(base::UsageError(command == &app ? "command line" : command->get_name(), error.what(), hint));
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app(usage(), "cloudgen");
  app.set_help_flag();
  app.allow_extras(false);
  cli::Terminal terminal;
  bool help = false, version = false, asJson = false;
  app.add_flag("-h,--help", help, "this text");
  app.add_flag("--version", version, "the version; with --json also what is built");
  app.add_flag("--json", asJson);
  std::vector<std::pair<CLI::App*, std::function<int()>>> runs;
  const std::map<std::string, cli::Terminal::ProgressMode> modes{
      {"auto", cli::Terminal::ProgressMode::Auto},
      {"always", cli::Terminal::ProgressMode::Always},
      {"never", cli::Terminal::ProgressMode::Never},
      {"json", cli::Terminal::ProgressMode::Json}};
  for (const auto& command : cli::commands()) {
    CLI::App* options = app.add_subcommand(std::string(command.name), std::string(command.summary));
    options->set_help_flag("-h,--help", "this text");
    options->add_option("--progress", terminal.progressMode, "auto, always, never or json")
        ->transform(CLI::CheckedTransformer(modes));
    options->add_flag("-q,--quiet", terminal.quiet, "only errors");
    options->add_flag("-v,--verbose", terminal.verbose, "say more");
    runs.emplace_back(options, command.setup(*options, terminal));
  }
  try {
    app.parse(count, arguments);
    if (version) return printVersion(asJson), 0;
    for (const auto& [options, run] : runs)
      if (options->parsed()) return run();
    cli::print(usage());
    return help ? 0 : static_cast<int>(base::Failure::Usage);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    cli::print(chosen.empty() ? usage() : chosen.front()->help());
    return 0;
  } catch (const CLI::ParseError& error) {
    return usageFailure(app, error);
  } catch (const base::Error& error) {
    return fail(error);
  } catch (const std::bad_alloc&) {
    return fail(
        base::OutputError("cloudgen", "memory ran out", "take a smaller --bbox or a lower --max-puffs"));
  } catch (const std::exception& error) {
    return fail(base::OutputError("cloudgen", error.what(),
                                  "this is a defect of cloudgen: please report it with the command"));
  }
}
