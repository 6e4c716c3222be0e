// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cloudgen::check {

/// How a list of numbers ended.
enum class ListEnd { Complete, NotANumber, NotFinite };

struct ListResult {
  std::uint64_t count = 0;  ///< numbers read
  ListEnd end = ListEnd::Complete;
  std::string_view piece;  ///< what could not be read
};

inline bool separatesNumbers(char c) { return c == ' ' || c == ',' || c == '\n' || c == '\t' || c == '\r'; }

namespace detail {

inline bool isFinite(double value) { return std::isfinite(value); }
inline bool isFinite(std::int64_t) { return true; }

/// The number at the front of `text`, and how many characters it takes; 0 if there is none.
template <typename Number>
std::size_t readNumber(std::string_view text, Number& value) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  if constexpr (std::is_integral_v<Number>) {
    if (end - begin > 2 && begin[0] == '0' && (begin[1] == 'x' || begin[1] == 'X')) {
      const auto [stop, problem] = std::from_chars(begin + 2, end, value, 16);
      return problem == std::errc() ? static_cast<std::size_t>(stop - text.data()) : 0;
    }
  }
  const auto [stop, problem] = std::from_chars(begin, end, value);
  if (problem == std::errc::invalid_argument || (begin != text.data() && begin != end && *begin == '-'))
    return 0;
  if constexpr (!std::is_integral_v<Number>) {
    // Out of range: as small as zero, or too large to be finite.
    if (problem != std::errc())
      value =
          std::string_view(begin, static_cast<std::size_t>(stop - begin)).find("e-") == std::string_view::npos
              ? HUGE_VAL
              : 0.0;
  } else if (problem != std::errc()) {
    return 0;
  }
  return static_cast<std::size_t>(stop - text.data());
}

}  // namespace detail

/// How many numbers stand in a list that is written plainly: decimals between blanks and commas, with an
/// exponent of one digit if any. Nothing where it is not, or where it is empty: forEachNumber tells.
inline std::optional<std::uint64_t> countPlainNumbers(std::string_view list) {
  const auto isDigit = [](char c) { return static_cast<unsigned char>(c - '0') < 10; };
  std::uint64_t count = 0;
  const char* at = list.data();
  const char* end = at + list.size();
  for (;;) {
    while (at != end && separatesNumbers(*at)) ++at;
    if (at == end) return count > 0 ? std::optional(count) : std::nullopt;
    if (*at == '-' || *at == '+') ++at;
    const char* start = at;
    while (at != end && isDigit(*at)) ++at;
    auto digits = at - start;
    if (at != end && *at == '.') {
      start = ++at;
      while (at != end && isDigit(*at)) ++at;
      digits += at - start;
    }
    if (digits == 0 || digits > 40) return {};
    if (at != end && (*at == 'e' || *at == 'E')) {
      ++at;
      if (at != end && (*at == '-' || *at == '+')) ++at;
      start = at;
      while (at != end && isDigit(*at)) ++at;
      if (at == start || at - start > 1) return {};
    }
    if (at != end && !separatesNumbers(*at)) return {};
    ++count;
  }
}

/// Reads numbers (double or int64) between blanks and commas by std::from_chars, locale-free, and hands them
/// over one by one. An integer may be hexadecimal ("0xff"). Stops at the first thing that is no finite
/// number.
template <typename Number, typename Take>
ListResult forEachNumber(std::string_view list, Take take) {
  ListResult result;
  for (;;) {
    std::size_t blanks = 0;
    while (blanks < list.size() && separatesNumbers(list[blanks])) ++blanks;
    list.remove_prefix(blanks);
    if (list.empty()) return result;
    Number value{};
    const std::size_t length = detail::readNumber(list, value);
    const bool whole = length > 0 && (length == list.size() || separatesNumbers(list[length]));
    if (!whole || !detail::isFinite(value)) {
      std::size_t end = 0;
      while (end < list.size() && !separatesNumbers(list[end])) ++end;
      result.piece = list.substr(0, end);
      result.end = whole ? ListEnd::NotFinite : ListEnd::NotANumber;
      return result;
    }
    ++result.count;
    take(value);
    list.remove_prefix(length);
  }
}

}  // namespace cloudgen::check
