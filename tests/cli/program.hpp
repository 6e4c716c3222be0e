// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cloudgen::test {

/// What a run of the program left.
struct Ran {
  int exitCode = -1;  ///< 128 + the signal, where one ended it
  std::string out, err;
};

struct RunOptions {
  std::map<std::string, std::string> environment;
  /// Asked every few milliseconds with the process's id; once it says yes, the program gets SIGINT.
  std::function<bool(int process)> interruptWhen;
};

/// Runs the built program and waits for its end; throws std::runtime_error if it cannot be started.
Ran runCloudgen(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Copies to `scene` what the program builds with these words (after "build", without -o) and returns what it left; in a
/// test program it builds but once with the same words.
Ran buildOnce(const std::vector<std::string>& words, const std::filesystem::path& scene);

/// The GFS forecast of Debian's python-grib-doc: $CLOUDGEN_GFS, or where the package puts it. Nothing if it
/// is not there.
std::optional<std::string> gfsForecast();

/// A file of ../shared/data, if it is there.
std::optional<std::string> sharedFile(const std::string& name);

/// A described sky of one small field of cumulus that builds in a moment; and a file of it.
std::string smallSky();
std::string smallSkyFile();

/// Names of everything in a folder and below it, hidden ones too, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// File names to contents; report.json without its timings.
std::map<std::string, std::string> contentOf(const std::filesystem::path& folder);

/// Names of files that are not the same in both, or in one only.
std::vector<std::string> differences(const std::map<std::string, std::string>& one,
                                     const std::map<std::string, std::string>& other);

}  // namespace cloudgen::test
