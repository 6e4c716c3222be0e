// SPDX-License-Identifier: Apache-2.0
// A step of the fluid against Stam's, written plainly and serial, in the same run; one line of JSON a grid.
//   cmake --preset release -DCLOUDGEN_TESTS=ON && cmake --build --preset release --target bench_fluid
//   build/release/tests/bench/bench_fluid
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "motion/fluid.hpp"
#include "support/fluid_divergence.hpp"
#include "support/plain_fluid.hpp"
#include "support/quickest.hpp"

namespace {

using namespace cloudgen;
using test::greatestDivergence;
using test::quickest;

void benchGrid(const glm::ivec3& cells) {
  constexpr float kViscosity = 0.02f;
  constexpr int kIterations = 20;
  base::RandomStream random(1, 1, base::Purpose::Test);
  motion::Fluid fluid(cells, 1);
  test::PlainFluid plain(cells);
  for (const int axis : {0, 1, 2})
    for (float& value : fluid.velocity(axis).values) value = static_cast<float>(random.uniform(-1, 1));
  for (int z = 0; z < cells.z; ++z)
    for (int x = 0; x < cells.x; ++x) fluid.velocity(1).at(x, 0, z) = fluid.velocity(1).at(x, cells.y, z) = 0;
  for (auto* field : {&plain.u, &plain.v, &plain.w})
    for (float& value : *field) value = static_cast<float>(random.uniform(-1, 1));
  for (float& value : fluid.smoke().values) value = static_cast<float>(random.uniform());
  plain.smoke = fluid.smoke().values;
  const test::PlainFluid start = plain;

  const double before = greatestDivergence(fluid);
  motion::Forcing forcing;
  forcing.viscosity = kViscosity;
  motion::Fluid projected = fluid;
  const double projection = quickest(5, [&] { projected = fluid, projected.project(); });
  const double ours = quickest(5, [&] { fluid.step(1, forcing); });
  const double twenty = quickest(2, [&] { plain = start, plain.step(kViscosity, kIterations, 0); });
  int iterations = 0;
  const double exact = quickest(1, [&] {
    plain = start;
    plain.step(kViscosity, kIterations, 1e-3f);
    iterations = plain.pressureIterations;
  });
  std::printf("%s\n", nlohmann::ordered_json({{"case", "fluid step"},
                                              {"cells", {cells.x, cells.y, cells.z}},
                                              {"step_s", ours},
                                              {"projection_s", projection},
                                              {"divergence_left", greatestDivergence(projected) / before},
                                              {"plain_1e-3_s", exact},
                                              {"plain_1e-3_iterations", iterations},
                                              {"times_faster", exact / ours},
                                              {"plain_20_iterations_s", twenty},
                                              {"times_faster_than_20_iterations", twenty / ours}})
                          .dump()
                          .c_str());
  std::fflush(stdout);
}

}  // namespace

int main() {
  for (const glm::ivec3& cells : {glm::ivec3(100, 20, 40), glm::ivec3(100, 40, 40), glm::ivec3(128)})
    benchGrid(cells);
}
