// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace cloudgen::input::mesh {

/// The words of a text, line by line; `#` begins a comment.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Goes to the next line, empty ones too; false at the end of the text.
  bool nextLine();
  /// Goes to the next line that has a word.
  bool nextFilledLine();
  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The next word as a number, or nothing if it is none.
  std::optional<double> number();
  std::optional<long long> whole();
  /// Counted from 1.
  int line() const { return line_; }
  /// What follows the line.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, current_;
  int line_ = 0;
};

}  // namespace cloudgen::input::mesh
