// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "support/scratch.hpp"

namespace cloudgen::test {
namespace fs = std::filesystem;

namespace {

std::string contentOfFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// In the child: redirects, and becomes the program.
[[noreturn]] void become(const std::vector<std::string>& arguments, const RunOptions& options,
                         const std::string& out, const std::string& err) {
  const auto redirect = [](const std::string& file, int descriptor) {
    ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
  };
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words{const_cast<char*>(CLOUDGEN_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execv(CLOUDGEN_PROGRAM, words.data());
  ::_exit(127);
}

int waitFor(int process, const RunOptions& options) {
  int status = 0;
  if (options.interruptWhen) {
    bool interrupted = false;
    while (::waitpid(process, &status, WNOHANG) == 0) {
      if (!interrupted && options.interruptWhen(process)) {
        ::kill(process, SIGINT);
        interrupted = true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  } else {
    ::waitpid(process, &status, 0);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Ran runCloudgen(const std::vector<std::string>& arguments, const RunOptions& options) {
  const Scratch scratch;
  const std::string out = scratch.path() / "out", err = scratch.path() / "err";
  const int process = ::fork();
  if (process < 0) throw std::runtime_error("fork failed");
  if (process == 0) become(arguments, options, out, err);
  Ran ran;
  ran.exitCode = waitFor(process, options);
  ran.out = contentOfFile(out);
  ran.err = contentOfFile(err);
  if (ran.exitCode == 127) throw std::runtime_error("cannot start " CLOUDGEN_PROGRAM);
  return ran;
}

std::optional<std::string> gfsForecast() {
  const std::string inside = "usr/share/doc/python-grib-doc/examples/gfs.t12z.pgrbf120.2p5deg.grib2";
  const char* chosen = std::getenv("CLOUDGEN_GFS");
  for (const std::string& file :
       {std::string(chosen ? chosen : ""), "/" + inside, CLOUDGEN_SOURCE_DIR "/build/data/" + inside})
    if (fs::exists(file)) return file;
  return std::nullopt;
}

std::optional<std::string> sharedFile(const std::string& name) {
  const std::string file = CLOUDGEN_SHARED_DIR "/data/" + name;
  return fs::exists(file) ? std::optional(file) : std::nullopt;
}

std::string smallSky() {
  return R"({"cloudgen_sky": 1, "title": "a small sky", "valid_time": "2026-06-21T20:00:00Z",
             "bbox": [-122.05, 36.75, -122.0, 36.8],
             "layers": [{"genus": "Cu", "cover": 0.2, "base_m": 1000, "top_m": 1800, "optical_depth": 20}]})";
}

std::string smallSkyFile() {
  static const Scratch folder;
  static const std::string file = folder.write("small.sky.json", smallSky());
  return file;
}

Ran buildOnce(const std::vector<std::string>& words, const fs::path& scene) {
  struct Built {
    Scratch folder;
    Ran ran;
  };
  static std::map<std::vector<std::string>, Built> known;
  const auto [found, isNew] = known.try_emplace(words);
  Built& built = found->second;
  const fs::path kept = built.folder.path() / "scene";
  if (isNew) {
    std::vector<std::string> all{"build", "-o", kept};
    all.insert(all.end(), words.begin(), words.end());
    built.ran = runCloudgen(all);
  }
  if (built.ran.exitCode == 0) fs::copy(kept, scene, fs::copy_options::recursive);
  return built.ran;
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      contents[entry.path().lexically_relative(folder).generic_string()] = contentOfFile(entry.path());
  if (auto report = contents.find("report.json"); report != contents.end()) {
    auto json = nlohmann::ordered_json::parse(report->second);
    json.erase("timings_seconds");
    report->second = json.dump(2);
  }
  return contents;
}

std::vector<std::string> differences(const std::map<std::string, std::string>& one,
                                     const std::map<std::string, std::string>& other) {
  std::set<std::string> names;
  for (const auto* side : {&one, &other})
    for (const auto& [name, content] : *side) names.insert(name);
  std::vector<std::string> differing;
  for (const std::string& name : names) {
    const auto a = one.find(name), b = other.find(name);
    if (a == one.end() || b == other.end() || a->second != b->second) differing.push_back(name);
  }
  return differing;
}

}  // namespace cloudgen::test
