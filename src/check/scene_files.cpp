// SPDX-License-Identifier: Apache-2.0
#include "check/scene_files.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "check/catalogue.hpp"

namespace cloudgen::check {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kWildcards = "*?[";
constexpr int kDepthLimit = 100;

bool isHidden(const std::string& name) { return name.starts_with("."); }

/// What stands in a folder, sorted; nothing where it cannot be read.
std::vector<fs::directory_entry> entriesOf(const fs::path& folder) {
  std::vector<fs::directory_entry> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error))
    entries.push_back(*at);
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool isFolder(const fs::directory_entry& entry) {
  std::error_code error;
  return entry.is_directory(error) && !entry.is_symlink(error);
}

/// Every scene in a folder and below it.
void collectScenes(const fs::path& folder, std::vector<fs::path>& found, int depth = 0) {
  if (depth > kDepthLimit) return;
  std::error_code error;
  for (const fs::directory_entry& entry : entriesOf(folder)) {
    const fs::path path = folder / entry.path().filename();
    if (isHidden(path.filename().string())) continue;
    if (isFolder(entry))
      collectScenes(path, found, depth + 1);
    else if (entry.is_regular_file(error) && fileKind(path))
      found.push_back(path);
  }
}

void collectMatches(const fs::path& folder, std::span<const std::string> names, std::vector<fs::path>& found,
                    int depth = 0);

/// What a name of a pattern has led to.
void follow(const fs::path& path, std::span<const std::string> rest, std::vector<fs::path>& found,
            int depth) {
  std::error_code error;
  if (rest.empty() && fs::is_regular_file(path, error)) found.push_back(path);
  if (!rest.empty() && fs::is_directory(path, error)) collectMatches(path, rest, found, depth + 1);
}

/// Follows the names of a pattern from a folder on.
void collectMatches(const fs::path& folder, std::span<const std::string> names, std::vector<fs::path>& found,
                    int depth) {
  if (names.empty() || depth > kDepthLimit) return;
  const std::string& name = names.front();
  const auto rest = names.subspan(1);
  if (name == "**") collectMatches(folder, rest, found, depth + 1);
  if (name != "**" && name.find_first_of(kWildcards) == name.npos) {
    follow(folder / name, rest, found, depth);
    return;
  }
  for (const fs::directory_entry& entry : entriesOf(folder)) {
    const std::string entryName = entry.path().filename().string();
    if (isHidden(entryName) && !isHidden(name)) continue;
    if (name == "**" && isFolder(entry))
      collectMatches(folder / entryName, names, found, depth + 1);
    else if (name != "**" && matchesName(name, entryName))
      follow(folder / entryName, rest, found, depth);
  }
}

std::vector<fs::path> filesOf(const std::string& word) {
  std::error_code error;
  std::vector<fs::path> found;
  if (fs::is_directory(word, error)) {
    collectScenes(word, found);
    if (found.empty())
      throw base::InputError(word, "holds no scene that can be validated", "known are " + knownEndings());
    return found;
  }
  // A file whose name has a bracket is that file.
  if (fs::exists(word, error) || word.find_first_of(kWildcards) == word.npos) return {word};
  const fs::path pattern(word);
  std::vector<std::string> names;
  for (const fs::path& part : pattern.relative_path()) names.push_back(part.string());
  if (names.back() == "**") names.emplace_back("*");
  collectMatches(pattern.root_path(), names, found);
  if (found.empty())
    throw base::InputError(word, "matches no file", "* stands for a part of a name, ** for any folders");
  std::sort(found.begin(), found.end());
  return found;
}

/// "[a-c]" at the front of a pattern against a character; `length` is what the bracket takes, 0 if it has no
/// end.
bool inBracket(std::string_view pattern, char c, std::size_t& length) {
  const std::size_t end = pattern.find(']', 2);
  length = end == pattern.npos ? 0 : end + 1;
  if (length == 0) return c == '[';
  std::string_view set = pattern.substr(1, end - 1);
  const bool negated = set.front() == '!' || set.front() == '^';
  if (negated) set.remove_prefix(1);
  bool in = false;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const bool isRange = i + 2 < set.size() && set[i + 1] == '-';
    in |= isRange ? set[i] <= c && c <= set[i + 2] : set[i] == c;
    if (isRange) i += 2;
  }
  return in != negated;
}

}  // namespace

bool matchesName(std::string_view pattern, std::string_view name) {
  std::size_t at = 0, in = 0, star = pattern.npos, starIn = 0;
  while (in < name.size()) {
    std::size_t length = 1;
    const bool more = at < pattern.size();
    bool fits = more && (pattern[at] == '?' || pattern[at] == name[in]);
    if (more && pattern[at] == '[') {
      fits = inBracket(pattern.substr(at), name[in], length);
      if (length == 0) length = 1;
    }
    if (more && pattern[at] == '*') {
      star = at++, starIn = in;
    } else if (fits) {
      at += length, ++in;
    } else if (star != pattern.npos) {
      at = star + 1, in = ++starIn;
    } else {
      return false;
    }
  }
  while (at < pattern.size() && pattern[at] == '*') ++at;
  return at == pattern.size();
}

std::vector<fs::path> sceneFiles(std::span<const std::string> words) {
  std::vector<fs::path> all;
  std::set<fs::path> seen;
  for (const std::string& word : words)
    for (const fs::path& file : filesOf(word))
      if (seen.insert(file.lexically_normal()).second) all.push_back(file);
  return all;
}

}  // namespace cloudgen::check
