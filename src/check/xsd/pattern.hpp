// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::check {

/// A regular expression of XML Schema (XML Schema Part 2, appendix F) as a deterministic automaton over the
/// bytes of ASCII text whose blanks are collapsed (whiteSpace "collapse"): a value is read once, a table
/// look-up a byte.
class Pattern {
 public:
  /// Nothing if the expression uses what is not known here (categories, blocks, subtraction, characters
  /// beyond ASCII), or is too large.
  static std::optional<Pattern> compiled(std::string_view expression);

  /// True if the value, collapsed, is accepted for certain. Of a value that is not pure ASCII nothing is
  /// certain.
  bool accepts(std::string_view value) const;
  /// A shortest text that is accepted.
  const std::string& shortest() const { return shortest_; }

 private:
  friend class PatternCompiler;

  std::array<std::uint8_t, 256> classOf_{};  ///< bytes that no part of the expression tells apart
  std::size_t classes_ = 0;
  std::vector<std::uint32_t> next_;  ///< at state * classes + class: the next state * classes
  std::vector<bool> accepting_;      ///< by state: 0 is dead, 1 the start
  std::string shortest_;
};

}  // namespace cloudgen::check
