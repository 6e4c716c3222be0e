// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cloudgen::base {

/// The shortest text that reads back as the same float; locale-free ("0.1", "1e-07", "-0" becomes "0").
std::string shortest(float value);
std::string shortest(double value);

/// The value with at most `decimals` digits after the point, trailing zeros cut; appended to `out`.
void appendFixed(std::string& out, double value, int decimals);

bool equalIgnoringCase(std::string_view a, std::string_view b);

/// The parts of a text between separators, blanks around them cut; empty parts are kept.
std::vector<std::string> split(std::string_view text, char separator);

/// A number that fills the whole text, or false. Accepts what std::from_chars accepts, finite only.
bool parseNumber(std::string_view text, double& value);

/// The bytes of the well-formed UTF-8 character (Unicode 15, table 3-7) at the front of a text that is not
/// empty; 0 if there is none, or one that XML 1.0 does not know (U+FFFE, U+FFFF).
std::size_t characterLength(std::string_view text);

/// A text for an XML attribute or element: what is markup and line breaks as references, what is no UTF-8 as
/// U+FFFD, other control characters as blanks.
std::string xmlEscaped(std::string_view text);

/// The candidate nearest to a mistyped word (edit distance at most a third of its length), or an empty text.
std::string nearestWord(std::string_view word, std::span<const std::string> candidates);

}  // namespace cloudgen::base
