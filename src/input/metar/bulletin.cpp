// SPDX-License-Identifier: Apache-2.0
#include "input/metar/bulletin.hpp"

#include <algorithm>
#include <string>

#include "input/metar/report.hpp"

namespace cloudgen::input {
namespace {

constexpr std::size_t kMostGroups = 100;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

struct Word {
  std::string_view text;
  std::size_t line = 1;
  bool ends = false;  ///< "=" behind it
};

/// Words of at most 40 bytes, cut at blanks, control characters and "="; longer ones are no group.
std::vector<Word> wordsOf(std::string_view text) {
  std::vector<Word> words;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const auto blank = [&](std::size_t at) { return static_cast<unsigned char>(text[at]) <= 32; };
    if (blank(i) || text[i] == '=') {
      if (text[i] == '\n') ++line;
      if (text[i] == '=' && !words.empty()) words.back().ends = true;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && !blank(end) && text[end] != '=') ++end;
    if (end - i <= 40) words.push_back({text.substr(i, end - i), line});
    i = end;
  }
  return words;
}

/// "0812/0912", as a TAF has behind its time.
bool isPeriod(std::string_view group) {
  return group.size() == 9 && group[4] == '/' && std::all_of(group.begin(), group.begin() + 4, isDigit) &&
         std::all_of(group.begin() + 5, group.end(), isDigit);
}

std::optional<base::UtcTime> dateFrom(std::string_view year, std::string_view month, std::string_view day) {
  const std::string iso = std::string(year) + "-" + std::string(month) + "-" + std::string(day) + "T12:00Z";
  const bool plausible = year.starts_with("19") || year.starts_with("20");
  return plausible ? base::utcFromIso(iso) : std::nullopt;
}

}  // namespace

std::vector<RawReport> findReports(std::string_view text) {
  const std::vector<Word> words = wordsOf(text);
  std::vector<RawReport> reports;
  std::optional<base::UtcTime> near;
  bool within = false, forecast = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i].text;
    if (word.size() == 10 && word[4] == '/' && word[7] == '/')
      if (const auto date = dateFrom(word.substr(0, 4), word.substr(5, 2), word.substr(8, 2))) {
        near = date;
        within = false;
      }
    if (word == "METAR" || word == "SPECI" || word == "TAF") {
      forecast = word == "TAF";
      within = false;
      continue;
    }
    if (i + 1 < words.size() && !words[i].ends && beginsReport(word, words[i + 1].text)) {
      within = !forecast && !(i + 2 < words.size() && isPeriod(words[i + 2].text));
      forecast = false;
      if (within) reports.push_back({{}, words[i].line, false, near});
    }
    if (!within) continue;
    if (reports.back().groups.size() < kMostGroups) reports.back().groups.push_back(word);
    within = !words[i].ends;
    reports.back().ended = words[i].ends;
  }
  return reports;
}

std::optional<base::UtcTime> dateInName(std::string_view name) {
  std::string digits;  // the digits of each run, "-" and "_" between two of them dropped
  for (std::size_t i = 0; i <= name.size(); ++i) {
    const bool joins = i < name.size() && (name[i] == '-' || name[i] == '_') && !digits.empty() &&
                       i + 1 < name.size() && isDigit(name[i + 1]) && digits.size() < 8;
    if (joins) continue;
    if (i < name.size() && isDigit(name[i])) {
      digits += name[i];
      continue;
    }
    if (digits.size() >= 8)
      if (const auto date =
              dateFrom(std::string_view(digits).substr(0, 4), std::string_view(digits).substr(4, 2),
                       std::string_view(digits).substr(6, 2)))
        return date;
    digits.clear();
  }
  return std::nullopt;
}

}  // namespace cloudgen::input
