// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string_view>

#include "base/progress.hpp"

namespace cloudgen::cli {

/// What every command shares: how loud it is.
struct Terminal {
  enum class ProgressMode { Auto, Always, Never, Json };
  ProgressMode progressMode = ProgressMode::Auto;
  bool quiet = false, verbose = false;

  /// Progress on stderr as chosen, and cancel on SIGINT and SIGTERM.
  base::Progress progress() const;
  /// One line on stderr, unless quiet.
  void say(std::string_view text) const;
  void warn(std::string_view text) const;
};

/// A command: `setup` declares its options (no I/O) and returns what runs it; that returns the exit code or
/// throws base::Error.
struct Command {
  std::string_view name, summary;
  std::function<int()> (*setup)(CLI::App& options, const Terminal& terminal);
};

/// Every command, in the order of the help text.
std::span<const Command> commands();

/// One a file: command_<name>.cpp.
std::function<int()> setupBuild(CLI::App&, const Terminal&);
std::function<int()> setupInspect(CLI::App&, const Terminal&);
std::function<int()> setupValidate(CLI::App&, const Terminal&);
std::function<int()> setupPreview(CLI::App&, const Terminal&);
std::function<int()> setupFilm(CLI::App&, const Terminal&);
std::function<int()> setupTextures(CLI::App&, const Terminal&);
std::function<int()> setupTypes(CLI::App&, const Terminal&);
std::function<int()> setupFormats(CLI::App&, const Terminal&);
std::function<int()> setupVerify(CLI::App&, const Terminal&);
std::function<int()> setupExplain(CLI::App&, const Terminal&);
std::function<int()> setupMerge(CLI::App&, const Terminal&);

/// The lines that a result for people or machines goes to: stdout.
void print(std::string_view text);

}  // namespace cloudgen::cli
