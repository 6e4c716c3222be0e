// SPDX-License-Identifier: Apache-2.0
// How long the program takes and how much memory, one line of JSON a case; with ratios to another tool
// measured in the same run.
//   cmake --preset release -DCLOUDGEN_TESTS=ON && cmake --build --preset release --target bench
//   build/release/tests/bench/bench build/release/src/cli/cloudgen FORECAST.grib2
// Needs a folder for temporary files and, for the comparison, xmllint.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Cost {
  double wallSeconds = 0, processorSeconds = 0, peakMegabytes = 0;
  bool succeeded = false;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// Runs a program without its output and says what it took.
Cost costOf(const std::vector<std::string>& command) {
  const auto start = std::chrono::steady_clock::now();
  const int process = ::fork();
  if (process == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(process, &status, 0, &usage);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {wall.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1024, status == 0};
}

/// The quickest of some runs: what disturbs a run only makes it slower.
Cost quickest(const std::vector<std::string>& command, int runs) {
  Cost best = costOf(command);
  for (int i = 1; i < runs; ++i)
    if (const Cost cost = costOf(command); cost.wallSeconds < best.wallSeconds) best = cost;
  return best;
}

void tell(nlohmann::ordered_json line, const Cost& cost) {
  line["ok"] = cost.succeeded;
  line["wall_s"] = std::round(cost.wallSeconds * 1000) / 1000;
  line["processor_s"] = std::round(cost.processorSeconds * 1000) / 1000;
  line["peak_mb"] = std::round(cost.peakMegabytes);
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

/// A sky of some genera in a chequered pattern around the globe, as a cloud analysis holds it.
std::string globalSky() {
  auto layers = nlohmann::json::array();
  const auto add = [&](const char* genus, double cover, int base, int top, int every) {
    auto cells = nlohmann::json::array();
    for (int cell = 0; cell < 72 * 36; ++cell)
      if (cell % every == 0) cells.push_back({cell % 72, cell / 72});
    layers.push_back({{"genus", genus},
                      {"cover", cover},
                      {"base_m", base},
                      {"top_m", top},
                      {"optical_depth", 8},
                      {"cells", cells}});
  };
  add("Sc", 0.6, 900, 1500, 3);
  add("Cu", 0.3, 1000, 2500, 4);
  add("Ac", 0.5, 4000, 4800, 4);
  add("Cs", 0.9, 9000, 10500, 3);
  return nlohmann::json{{"cloudgen_sky", 1},
                        {"valid_time", "2011-01-15T12:00:00Z"},
                        {"bbox", {-180, -90, 180, 90}},
                        {"grid", {{"columns", 72}, {"rows", 36}}},
                        {"layers", layers}}
      .dump();
}

std::vector<std::string> filesIn(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Opening and visiting everything against reading (and decoding) the same files with what is there anyway.
void benchReader(const std::string& name, const std::string& plainly, const std::vector<std::string>& files) {
  const auto command = [&](const std::string& how) {
    std::vector<std::string> words{READ_INPUT, how};
    words.insert(words.end(), files.begin(), files.end());
    return words;
  };
  const Cost ours = quickest(command("cloudgen"), 5), theirs = quickest(command(plainly), 5);
  tell({{"case", "read " + name},
        {"plainly", plainly},
        {"plainly_wall_s", theirs.wallSeconds},
        {"takes_times_as_long", ours.wallSeconds / theirs.wallSeconds}},
       ours);
}

void benchReaders(const fs::path& folder, const std::string& forecast) {
  const std::string sky = folder / "globe.sky.json";
  std::ofstream(sky) << globalSky();
  for (const std::string kind : {"grib", "raw"}) {
    costOf({WWMCA_FROM_SKY, sky, folder / kind, "--" + kind});
    benchReader("WWMCA pair as " + kind, kind == "grib" ? "eccodes" : "bytes", filesIn(folder / kind));
  }
  benchReader("forecast", "eccodes", {forecast});
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: %s CLOUDGEN FORECAST\n", arguments[0]);
    return 2;
  }
  const std::string program = arguments[1], forecast = arguments[2];
  const fs::path folder = fs::temp_directory_path() / ("cloudgen-bench-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  benchReaders(folder, forecast);
  const std::string scene = folder / "scene", x3d = folder / "scene" / "scene.x3d";

  for (const auto& [name, box] :
       {std::pair{"theatre", "-122.6,36.2,-121.2,37.2"}, std::pair{"regional", "-100,25,-60,50"}}) {
    const Cost cost = quickest({program, "build", forecast, "--bbox", box, "-o", scene, "--overwrite"}, 2);
    tell({{"case", std::string("build ") + name}}, cost);
  }
  const double megabytes = fs::exists(x3d) ? static_cast<double>(fs::file_size(x3d)) / 1e6 : 0;
  const Cost ours = quickest({program, "validate", x3d}, 3);
  tell({{"case", "validate regional scene.x3d"},
        {"megabytes", megabytes},
        {"megabytes_per_s", megabytes / ours.wallSeconds}},
       ours);
  // Well-formedness only, and the same schema without the rules that go beyond it.
  const std::string schema = CLOUDGEN_SOURCE_DIR "/schemas/cloudgen-x3d.xsd";
  for (const std::vector<std::string>& checks : {std::vector<std::string>{}, {"--schema", schema}}) {
    std::vector<std::string> command{"xmllint", "--stream", "--noout", "--nonet"};
    command.insert(command.end(), checks.begin(), checks.end());
    command.push_back(x3d);
    const Cost theirs = quickest(command, 3);
    tell({{"case", checks.empty() ? "xmllint --stream" : "xmllint --stream --schema"},
          {"megabytes_per_s", megabytes / theirs.wallSeconds},
          {"validate_takes_times_as_long", ours.wallSeconds / theirs.wallSeconds}},
         theirs);
  }
  fs::remove_all(folder);
}
