// SPDX-License-Identifier: Apache-2.0
#include "input/mesh/words.hpp"

#include <charconv>

#include "base/text.hpp"

namespace cloudgen::input::mesh {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

}  // namespace

bool Words::nextLine() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  current_ = rest_.substr(0, end);
  current_ = current_.substr(0, current_.find('#'));
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++line_;
  return true;
}

bool Words::nextFilledLine() {
  while (nextLine())
    if (current_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
  return false;
}

std::string_view Words::word() {
  current_.remove_prefix(std::min(current_.find_first_not_of(kBlanks), current_.size()));
  const std::string_view word = current_.substr(0, current_.find_first_of(kBlanks));
  current_.remove_prefix(word.size());
  return word;
}

std::optional<double> Words::number() {
  std::string_view text = word();
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  if (!base::parseNumber(text, value)) return std::nullopt;
  return value;
}

std::optional<long long> Words::whole() {
  const std::string_view text = word();
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace cloudgen::input::mesh
