// SPDX-License-Identifier: Apache-2.0
// Not a test: validates scenes by cloudgen and by `xmllint --stream --schema`, one after the other, and
// prints a line of JSON each: seconds on the clock, of the processor, and peak memory. bench_validate PROGRAM
// SCHEMA SCENE... Without a scene it makes one of 500 MB and one of many small elements.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Runs a command without its output and prints how it went.
void measure(const std::string& tool, const Words& words, const fs::path& scene, const std::string& schema) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  const double megabytes = static_cast<double>(fs::file_size(scene)) / 1e6;
  const nlohmann::ordered_json line{{"case", "validate"},
                                    {"tool", tool},
                                    {"scene", scene.filename().string()},
                                    {"schema", fs::path(schema).filename().string()},
                                    {"megabytes", megabytes},
                                    {"exit", WIFEXITED(status) ? WEXITSTATUS(status) : -1},
                                    {"seconds", seconds.count()},
                                    {"cpu_seconds", of(usage.ru_utime) + of(usage.ru_stime)},
                                    {"megabytes_per_second", megabytes / seconds.count()},
                                    {"peak_mb", static_cast<double>(usage.ru_maxrss) / 1024}};
  std::puts(line.dump().c_str());
  std::fflush(stdout);
}

/// A scene of so many cards to a shape and shapes, one Billboard each.
void writeScene(const fs::path& file, int shapes, int cards) {
  std::ofstream out(file);
  out << "<X3D profile=\"Immersive\" version=\"4.0\">\n<Scene>\n";
  for (int i = 0; i < shapes; ++i) {
    out << "<Transform DEF=\"T" << i << "\" translation=\"" << i % 317 << ".5 100.25 " << i / 317
        << "\"><Billboard axisOfRotation=\"0 0 0\"><Shape>\n<Appearance DEF=\"A" << i
        << "\"><Material emissiveColor=\"1 1 1\" transparency=\"0.2\"/></Appearance>\n<IndexedTriangleSet "
           "index=\"";
    for (int k = 0; k < cards; ++k)
      for (const int corner : {0, 1, 2, 0, 2, 3}) out << 4 * k + corner << ' ';
    out << "\" solid=\"false\"><Coordinate point=\"";
    for (int k = 0; k < cards; ++k)
      out << k << ".125 -1.5 " << i % 7 << ' ' << k << ".75 1.5 -3 " << -k << " 2.5 0.0625 0 -12.5 " << k
          << ".5 ";
    out << "\"/></IndexedTriangleSet>\n</Shape></Billboard></Transform>\n";
  }
  out << "</Scene>\n</X3D>\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("bench_validate PROGRAM SCHEMA [SCENE...]\n", stderr);
    return 2;
  }
  const std::string program = argv[1], schema = argv[2];
  std::vector<fs::path> scenes(argv + 3, argv + argc);
  const fs::path folder = fs::temp_directory_path() / ("bench-validate-" + std::to_string(getpid()));
  if (scenes.empty()) {
    fs::create_directories(folder);
    scenes = {folder / "large.x3d", folder / "small_elements.x3d"};
    writeScene(scenes[0], 5000, 900);
    writeScene(scenes[1], 90000, 1);
  }
  for (const fs::path& scene : scenes) {
    measure("xmllint", {"xmllint", "--nonet", "--noout", "--stream", "--schema", schema, scene}, scene,
            schema);
    measure("cloudgen", {program, "validate", "--schema", schema, scene}, scene, schema);
  }
  fs::remove_all(folder);
  return 0;
}
