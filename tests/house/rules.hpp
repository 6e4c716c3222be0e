// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::house {

/// A line that breaks a rule of the house. `line` counts from 1; 0 is the file as a whole.
struct Violation {
  std::string file;
  int line = 0;
  std::string rule, what;

  bool operator==(const Violation&) const = default;
};

/// The violation as one line: file:line: rule: what.
std::string text(const Violation& violation);

/// Breaks of the rules by one file. `file` is its path from the root of the repository
/// ("src/base/error.hpp"), which decides what rules hold for it; `content` is its text. Binary files are held
/// to no rule.
std::vector<Violation> violationsIn(std::string_view file, std::string_view content);

/// The files that people wrote, as paths from `root`: no build folders, outputs, fetched packages or version
/// control.
std::vector<std::string> sourceFiles(const std::filesystem::path& root);

}  // namespace cloudgen::house
