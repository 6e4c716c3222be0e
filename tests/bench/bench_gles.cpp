// SPDX-License-Identifier: Apache-2.0
// Frames of the renderer in the tests of the thesis on clouds for in-flight displays (LTH 2024): A to E are 0, 10, 30,
// 75 and 200 clouds of 40 puffs, strewn or clustered, sorted lazily or in every frame, and E once more without culling, levels
// of detail, impostors and adaptive resolution. bench_gles [FRAMES] prints one line of JSON a case.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/gles_picture.hpp"
#include "support/made_pack.hpp"
#include "support/runtime_path.hpp"

namespace {

using namespace cloudgen;
using Clock = std::chrono::steady_clock;

constexpr int kWidth = 1280, kHeight = 720, kPuffs = 40;
constexpr float kSide = 60'000;

double millisecondsSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

/// Heaps at one level over a square; in clusters of seven they overlap.
scene::Scene heaps(int clouds, bool clustered) {
  scene::Scene scene = test::wideSky(7, kPuffs, std::max(clouds, 1), kSide);
  if (clouds == 0) {
    scene.instances.clear();
    scene.clouds.clear();
    scene.lit.clear();
    scene.archetypes.clear();
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    glm::vec3& place = scene.instances[i].position;
    place.y = 900 + 40 * static_cast<float>(i % 7);
    if (!clustered || i % 7 == 0) continue;
    const float angle = static_cast<float>(i % 7);
    place = scene.instances[i - i % 7].position + 1400.0f * glm::vec3(std::cos(angle), 0, std::sin(angle));
  }
  return scene;
}

struct Case {
  const char* name;
  int clouds;
  bool clustered = false, lazy = true, plain = false;
};

double run(const Case& test, int frames) {
  const scene::Scene scene = heaps(test.clouds, test.clustered);
  const std::string bytes = writer::packBytes(scene, writer::packed::picturesOf(scene));
  runtime::RuntimeOptions options;
  options.detail.impostorPixels = test.plain ? 0.0f : 48.0f;
  if (test.plain) options.detail.errorPixels = 0;
  if (test.plain) options.lazy.turnRadians = 4;
  if (!test.lazy) options.lazy.moveMeters = 0, options.lazy.slices = 1;
  runtime::Runtime sky;
  runtime::gles::Renderer renderer;
  const float target = test.plain ? 0.0f : 33.0f;
  if (!sky.open(test::bytesOf(bytes), options)) std::exit(1);
  if (const auto made = renderer.make(sky, test::decodePng, kWidth, kHeight, {1, target}); !made) {
    std::fprintf(stderr, "bench_gles: %s\n", made.problem);
    std::exit(1);
  }
  const test::Canvas canvas(kWidth, kHeight);
  double update = 0, whole = 0, last = 0, worst = 0;
  std::size_t puffs = 0;
  // The first frames bring the resolution to where it stays.
  const int before = test.plain ? 1 : 20;
  for (int f = -before; f < frames; ++f) {
    const runtime::Camera camera = test::flightCamera(f + before, kSide);
    const auto start = Clock::now();
    const runtime::Frame frame = sky.update(camera);
    const double updated = millisecondsSince(start);
    renderer.draw(frame, camera, canvas.target.id(), last);
    glFinish();
    last = millisecondsSince(start);
    if (f < 0) continue;
    update += updated;
    whole += last;
    worst = std::max(worst, last);
    puffs += frame.puffs.size();
  }
  const double mean = whole / frames;
  const nlohmann::ordered_json line{{"case", test.name}, {"clouds", test.clouds}, {"puffs_each", kPuffs}, {"clustered", test.clustered}, {"lazy", test.lazy},
                                    {"all_off", test.plain}, {"width", kWidth}, {"height", kHeight}, {"frames", frames}, {"fps", 1000 / mean},
                                    {"frame_ms", mean}, {"frame_worst_ms", worst}, {"update_ms", update / frames},
                                    {"drawn", puffs / static_cast<std::size_t>(frames)}, {"scale", renderer.scale()}};
  std::printf("%s\n", line.dump().c_str());
  return mean;
}

}  // namespace

int main(int count, char** arguments) {
  const int frames = std::max(1, count > 1 ? std::atoi(arguments[1]) : 100);
  runtime::gles::HeadlessContext context;
  if (const auto opened = context.open(); !opened) {
    std::fprintf(stderr, "bench_gles: %s\n", opened.problem);
    return 1;
  }
  double all = 1;
  for (const auto& [name, clouds] : {std::pair{"A", 0}, {"B", 10}, {"C", 30}, {"D", 75}, {"E", 200}})
    for (const bool clustered : {false, true})
      for (const bool lazy : {true, false}) {
        const double mean = run({name, clouds, clustered, lazy}, frames);
        if (clouds == 200 && !clustered && lazy) all = mean;
      }
  const double plain = run({"E", 200, false, false, true}, std::max(1, frames / 10));
  const nlohmann::ordered_json line{{"case", "E against itself with all off"}, {"times_faster", plain / all}};
  std::printf("%s\n", line.dump().c_str());
  return 0;
}
