// SPDX-License-Identifier: Apache-2.0
// How long light takes, one line of JSON a case, the first ones on one thread.
//   cmake --preset release -DCLOUDGEN_TESTS=ON && cmake --build --preset release --target bench_light
//   build/release/tests/bench/bench_light [FORECAST...]
// With a forecast also the share of light in its whole build, all its formats written.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "base/data_dir.hpp"
#include "base/random.hpp"
#include "input/catalogue.hpp"
#include "light/optics.hpp"
#include "light/sweep.hpp"
#include "light/transfer.hpp"
#include "pipeline/pipeline.hpp"
#include "support/quickest.hpp"
#include "support/ray_march.hpp"
#include "writer/catalogue.hpp"

namespace {

using namespace cloudgen;
using test::quickest;

/// A box full of puffs, so that the grid has `cells` along each side.
std::vector<shape::Puff> boxOfPuffs(int count, std::uint64_t seed) {
  base::RandomStream random(seed, 0, base::Purpose::Test);
  std::vector<shape::Puff> puffs(static_cast<std::size_t>(count));
  for (shape::Puff& puff : puffs) {
    puff.center = {random.uniform(-500, 500), random.uniform(0, 1000), random.uniform(-500, 500)};
    puff.sigma = glm::vec3(random.uniform(40, 120));
    puff.extinctionPerMeter = 0.02f;
  }
  return puffs;
}

void tell(const nlohmann::ordered_json& line) {
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

void benchSweep() {
  const auto puffs = boxOfPuffs(600, 1);
  const light::ExtinctionGrid grid(puffs, 37);
  const glm::vec3 sun = glm::normalize(glm::vec3(0.4f, 0.6f, 0.3f));
  light::DepthSweep sweep(grid);
  const double swept = quickest(20, [&] { sweep.towards(sun); });
  double sum = 0;
  const double marched = quickest(2, [&] {
    const glm::ivec3 size = grid.size();
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
          sum += test::marchedDepth(grid, test::cellCenter(grid, x, y, z), sun, 1.0f);
  });
  tell({{"case", "sweep"},
        {"cells", {grid.size().x, grid.size().y, grid.size().z}},
        {"sweep_s", swept},
        {"ray_a_cell_s", marched},
        {"times_faster", marched / swept},
        {"depths", sum > 0}});
}

void benchArchetypes() {
  constexpr int kArchetypes = 300;
  std::vector<std::vector<shape::Puff>> clouds;
  for (int i = 0; i < kArchetypes; ++i) clouds.push_back(boxOfPuffs(300, static_cast<std::uint64_t>(i)));
  glm::ivec3 size(0);
  float bright = 0;
  const double seconds = quickest(2, [&] {
    for (const auto& puffs : clouds) {
      const light::ExtinctionGrid grid(puffs, 21);
      size = grid.size();
      bright += light::bakeTransfer(puffs, grid, light::kWaterAsymmetry).bright;
    }
  });
  tell({{"case", "transfer of 300 archetypes of 300 puffs"},
        {"cells", {size.x, size.y, size.z}},
        {"wall_s", seconds},
        {"lit", bright > 0}});
}

/// The share of its light in a build, by the stages that the build itself reports.
void benchBuild(const std::vector<std::filesystem::path>& forecast) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const Clock::time_point start = Clock::now();
  Clock::time_point lightStart = start, lightEnd = start;
  base::Progress progress;
  progress.report = [&](std::string_view stage, double share) {
    if (stage == "production: light") (share < 1 ? lightStart : lightEnd) = Clock::now();
  };
  const auto source = input::open(forecast);
  pipeline::Options options;
  options.recipes = pipeline::readRecipes(base::dataDir() / "templates" / "types");
  const pipeline::Outcome outcome = pipeline::run(*source, options, progress);
  const auto folder = std::filesystem::temp_directory_path() / "cloudgen_bench_light";
  std::filesystem::create_directories(folder);
  for (const writer::Format& format : writer::formats()) format.write(outcome.scene, {folder, {}});
  const Clock::time_point end = Clock::now();
  std::filesystem::remove_all(folder);
  tell({{"case", "light of a whole build"},
        {"archetypes", outcome.scene.archetypes.size()},
        {"headings", outcome.scene.lit.size()},
        {"light_s", seconds(lightEnd - lightStart)},
        {"build_s", seconds(end - start)},
        {"share", seconds(lightEnd - lightStart) / seconds(end - start)}});
}

}  // namespace

int main(int argc, char** argv) {
  benchSweep();
  benchArchetypes();
  if (argc > 1) benchBuild({argv + 1, argv + argc});
}
