// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::check {

enum class Severity { Warning, Error };

/// "warning" or "error".
std::string_view name(Severity severity);

/// A place in a text, counted from 1; a column counts bytes. Zero where the file has no lines (.glb).
struct Position {
  std::uint64_t line = 0, column = 0;
};

/// What is wrong in a file, where, by which rule, and what to do about it.
struct Finding {
  Severity severity = Severity::Error;
  std::string file;
  std::uint64_t line = 0, column = 0;
  std::string rule;     ///< a stable name, "index-range"
  std::string message;  ///< one line
  std::string hint;     ///< one line
};

/// "file:line:column: error[rule]: message (hint)".
std::string text(const Finding& finding);

struct ValidationResult {
  std::vector<Finding> findings;  ///< in the order of the file
  std::uint64_t elements = 0;     ///< XML elements, VRML nodes and routes, or glTF objects
  std::uint64_t nodes = 0;        ///< scene nodes among them (USE counts)
  std::uint64_t bytes = 0;

  /// No error; warnings are allowed.
  bool valid() const;
};

/// Collects the findings of one file. After kLimit of them it is full: the checker may stop.
class FindingList {
 public:
  static constexpr std::size_t kLimit = 1000;

  FindingList(std::string file, ValidationResult& result) : file_(std::move(file)), result_(&result) {}

  void error(Position where, std::string_view rule, std::string message, std::string hint) {
    add(Severity::Error, where, rule, std::move(message), std::move(hint));
  }
  void warning(Position where, std::string_view rule, std::string message, std::string hint) {
    add(Severity::Warning, where, rule, std::move(message), std::move(hint));
  }
  bool full() const { return result_->findings.size() >= kLimit; }
  ValidationResult& result() { return *result_; }
  /// Brings the findings into the order of the file.
  void sort();

 private:
  void add(Severity severity, Position where, std::string_view rule, std::string message, std::string hint);

  std::string file_;
  ValidationResult* result_;
};

/// A piece of a scene as it may stand in a message: control characters blanked, at most 60 bytes.
std::string excerpt(std::string_view piece);

}  // namespace cloudgen::check
