// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "field/source.hpp"
#include "input/open_options.hpp"

namespace cloudgen::cli {

/// What build and inspect share about their input, as written on the command line.
struct InputLine {
  std::vector<std::string> inputs;
  std::string time = "first", place, byteOrder, stations;

  bool allTimes() const { return time == "all"; }
};

/// Declares INPUT, --time, --at, --byte-order and --stations.
void addInputOptions(CLI::App& options, InputLine& line);

/// Declares --time, --at, --byte-order and --stations alone, where INPUT has another name.
void addReadingOptions(CLI::App& options, InputLine& line);

/// The options read; throws UsageError with what is wrong.
input::OpenOptions openOptions(const InputLine& line);

std::unique_ptr<field::Source> openInput(const InputLine& line);

/// The typing (a file, a folder) at the valid time nearest to `time`. Throws InputError where that is further
/// away than `windowMinutes`.
std::unique_ptr<field::Source> openTyping(const std::string& path, const InputLine& line, base::UtcTime time,
                                          double windowMinutes);

}  // namespace cloudgen::cli
