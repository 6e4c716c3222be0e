// SPDX-License-Identifier: Apache-2.0
// Splats against the time of writing the same bytes; needs nothing. bench_splats [MILLIONS_OF_SPLATS...] prints one line of JSON
// a sky: seconds of both (the least of three), their ratio, bytes a splat and the most memory the program ever held beyond the sky.
#include <sys/resource.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "support/quickest.hpp"
#include "support/gltf_scene.hpp"
#include "support/scratch.hpp"
#include "writer/gltf/gltf.hpp"

namespace {

using namespace cloudgen;

constexpr int kPuffsOfHeap = 500;

/// Heaps in rows, so many puffs together.
scene::Scene skyOf(double millions) {
  const int rows = static_cast<int>(std::lround(std::sqrt(millions * 1e6 / kPuffsOfHeap)));
  return test::gltfScene(kPuffsOfHeap, rows, {0, 40, 10, 48});
}

double megabytesHeld() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void run(double millions) {
  const scene::Scene scene = skyOf(millions);
  const test::Scratch folder;
  const double before = megabytesHeld();
  const double seconds = test::quickest(3, [&] { writer::writeSplats(scene, {folder.path(), {}}); });
  const double held = megabytesHeld() - before;
  const std::string bytes = base::readFile(folder.path() / "scene.splats.glb");
  const double plain = test::quickest(3, [&] { base::writeFile(folder.path() / "bytes", bytes); });
  const auto splats = static_cast<double>(scene::drawnPuffs(scene));
  nlohmann::ordered_json line{{"case", "splats"},
                              {"splats", scene::drawnPuffs(scene)},
                              {"seconds", seconds},
                              {"seconds_same_bytes", plain},
                              {"ratio", seconds / plain},
                              {"bytes_a_splat", static_cast<double>(bytes.size()) / splats},
                              {"megabytes_held", held}};
  std::printf("%s\n", line.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) run(1);
  for (int i = 1; i < argc; ++i) run(std::atof(argv[i]));
}
