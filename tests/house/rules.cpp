// SPDX-License-Identifier: Apache-2.0
#include "house/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "house/tables.hpp"

namespace cloudgen::house {
namespace {

namespace fs = std::filesystem;
using std::string_view;

bool beginsWithOneOf(string_view file, const std::set<string_view>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](string_view begin) { return file.starts_with(begin); });
}

bool endsWithOneOf(string_view file, std::initializer_list<string_view> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](string_view end) { return file.ends_with(end); });
}

bool isCpp(string_view file) { return endsWithOneOf(file, {".cpp", ".hpp"}); }
bool isSource(string_view file) {
  return isCpp(file) || endsWithOneOf(file, {".ts", ".mjs", ".js", ".sh", ".ci/run"});
}
bool isGenerated(string_view file) { return file.ends_with("package-lock.json"); }

/// A line with what matters about where it stands.
struct Line {
  string_view file, text;
  int number;
};

/// The room of an include that starts with one ("base" of "base/error.hpp"), or nothing.
string_view roomOf(string_view header) {
  const string_view folder = header.substr(0, header.find('/'));
  const auto isIt = [&](const Room& room) { return room.folder.substr(4, room.folder.size() - 5) == folder; };
  return std::any_of(kRooms.begin(), kRooms.end(), isIt) ? folder : string_view();
}

void checkRoom(const Line& line, string_view header, std::vector<Violation>& found) {
  const string_view used = roomOf(header);
  const auto home = std::find_if(kRooms.begin(), kRooms.end(),
                                 [&](const Room& room) { return line.file.starts_with(room.folder); });
  if (home == kRooms.end()) {
    found.push_back({std::string(line.file), line.number, "room",
                     "stands in no room of the house (tests/house/tables.hpp)"});
    return;
  }
  const string_view own = home->folder.substr(4, home->folder.size() - 5);
  if (used.empty())
    found.push_back({std::string(line.file), line.number, "include",
                     fmt::format("\"{}\" is not a path from src/", header)});
  else if (used != own && !home->mayUse.contains(used))
    found.push_back(
        {std::string(line.file), line.number, "room", fmt::format("{} may not use {}", own, used)});
}

void checkLibrary(const Line& line, string_view header, std::vector<Violation>& found) {
  const auto refuse = [&](string_view library) {
    found.push_back({std::string(line.file), line.number, "library",
                     fmt::format("<{}> is private to another room", library)});
  };
  for (const Library& library : kLibraries)
    if (header.starts_with(library.header) && !beginsWithOneOf(line.file, library.owners)) refuse(header);
  if (header.starts_with("nlohmann/") && !beginsWithOneOf(line.file, kJsonOwners)) refuse(header);
}

void checkInclude(const Line& line, std::vector<Violation>& found) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::match_results<string_view::const_iterator> match;
  if (!std::regex_search(line.text.begin(), line.text.end(), match, kInclude)) return;
  const std::string header = match[2];
  if (match[1] == "\"") checkRoom(line, header, found);
  checkLibrary(line, header, found);
}

string_view withoutComment(string_view text) { return text.substr(0, text.find("//")); }

void checkWords(const Line& line, std::vector<Violation>& found) {
  static const std::regex kPrinting(
      R"((\b(v?f?printf|puts|fputs|putchar|perror)\s*\()|\bstd::(cout|cerr|clog)\b|\bfmt::print\b)");
  static const std::regex kChance(R"(\b(rand|srand|random|drand48)\s*\(|\bstd::(random_device|mt19937))");
  static const std::regex kLeaving(R"((^|[^.\w])(exit|abort|_exit|quick_exit)\s*\()");
  const string_view code = withoutComment(line.text);
  const auto has = [&](const std::regex& words) {
    return std::regex_search(code.begin(), code.end(), words);
  };
  const bool isCli = line.file.starts_with("src/cli/") || line.file.starts_with("src/fly/");
  if (!isCli && has(kPrinting))
    found.push_back({std::string(line.file), line.number, "print", "only src/cli/ prints"});
  if (has(kChance))
    found.push_back(
        {std::string(line.file), line.number, "chance", "random numbers come from base/random.hpp"});
  if (!isCli && line.file != kChildProcess && has(kLeaving))
    found.push_back(
        {std::string(line.file), line.number, "exit", "a library throws, only src/cli/ ends the program"});
}

void checkPaths(const Line& line, std::vector<Violation>& found) {
  // Put together, so that this file passes its own rule.
  static const std::regex kHome(std::string("(^|[\\s\"'`=(:])/(ho") + "me|wo" + "rk|ro" + "ot|Us" +
                                "ers)/\\w");
  if (std::regex_search(line.text.begin(), line.text.end(), kHome))
    found.push_back({std::string(line.file), line.number, "path", "a path of somebody's machine"});
}

}  // namespace

std::string text(const Violation& violation) {
  return fmt::format("{}:{}: {}: {}", violation.file, violation.line, violation.rule, violation.what);
}

std::vector<Violation> violationsIn(string_view file, string_view content) {
  std::vector<Violation> found;
  if (content.find('\0') != string_view::npos) return found;
  int number = 0;
  for (std::size_t start = 0; start < content.size(); ++number) {
    const std::size_t end = std::min(content.find('\n', start), content.size());
    const Line line{file, content.substr(start, end - start), number + 1};
    if (isCpp(file) && file.starts_with("src/")) {
      checkInclude(line, found);
      checkWords(line, found);
    }
    if (line.text.size() < 4096) checkPaths(line, found);
    start = end + 1;
  }
  if (isSource(file) &&
      content.substr(0, 200).find("SPDX-License-Identifier: Apache-2.0") == string_view::npos)
    found.push_back({std::string(file), 1, "licence", "has no line SPDX-License-Identifier: Apache-2.0"});
  if (number > kMostLines && isSource(file) && !isGenerated(file))
    found.push_back(
        {std::string(file), 0, "length", fmt::format("has {} lines, over {}", number, kMostLines)});
  return found;
}

std::vector<std::string> sourceFiles(const fs::path& root) {
  static const std::set<std::string> kNotOurs{".git", "node_modules", "out", "dist"};
  std::vector<std::string> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() &&
        (kNotOurs.contains(name) || (entry.depth() == 0 && name.starts_with("build"))))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file() && name != ".git")
      files.push_back(entry->path().lexically_relative(root).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace cloudgen::house
