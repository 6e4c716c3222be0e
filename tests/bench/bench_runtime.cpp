// SPDX-License-Identifier: Apache-2.0
// The CPU side of a frame: culling, choice of levels and lazy order against transforming and std::sort-ing every puff, along
// a flight through a made sky. bench_runtime [CLOUDS PUFFS_A_CLOUD ARCHETYPES SIDE_KM]... prints one line of JSON a sky.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/pack_scene.hpp"
#include "support/runtime_path.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen;
using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Times {
  double mean = 0, worst = 0, median = 0;
};

Times timesOf(std::vector<double> all) {
  Times times;
  for (const double one : all) times.mean += one / static_cast<double>(all.size());
  std::sort(all.begin(), all.end());
  times.worst = all.back();
  times.median = all[all.size() / 2];
  return times;
}

/// What an engine does without any of this: every puff into the camera's space, and all sorted by depth.
class Naive {
 public:
  explicit Naive(const runtime::PackView& pack) {
    for (std::uint32_t i = 0; i < pack.instances().size(); ++i) {
      const pack::Instance& cloud = pack.instances()[i];
      const runtime::ArchetypeInfo& info = pack.archetypes()[cloud.archetype()];
      for (std::uint32_t p = info.first[0]; p < info.first[0] + info.count[0]; ++p) {
        puffs_.push_back({i, p});
        places_.push_back(runtime::placed(cloud, runtime::turnOf(cloud.yaw_step()), pack.centers()[p]));
      }
    }
    depths_.resize(puffs_.size());
  }
  void frame(const runtime::Camera& camera) {
    const runtime::Vec3 ahead = runtime::normalized(camera.forward);
    for (std::uint32_t i = 0; i < puffs_.size(); ++i) depths_[i] = {runtime::dot(places_[i] - camera.eye, ahead), i};
    std::sort(depths_.begin(), depths_.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  }
  std::size_t puffs() const { return puffs_.size(); }

 private:
  std::vector<runtime::DrawPuff> puffs_;
  std::vector<runtime::Vec3> places_;
  std::vector<std::pair<float, std::uint32_t>> depths_;
};

void run(int clouds, int puffsEach, int archetypes, float sideMeters) {
  const scene::Scene scene = test::wideSky(archetypes, puffsEach, clouds, sideMeters);
  const test::Scratch folder;
  writer::writePack(scene, {folder.path(), {}});
  const auto file = folder.path() / "scene.cgpack";

  std::vector<double> openings;
  for (int i = 0; i < 9; ++i) {
    runtime::PackView view;
    const auto start = Clock::now();
    if (!view.open(file.c_str())) std::exit(1);
    openings.push_back(millisecondsSince(start));
  }
  runtime::Runtime sky;
  auto start = Clock::now();
  if (!sky.open(file.c_str())) std::exit(1);
  const double ready = millisecondsSince(start);
  start = Clock::now();
  sky.setSun({200, 30});
  const double sunUpdate = millisecondsSince(start);

  constexpr int kFrames = 1200, kNaiveEvery = 60, kFlights = 5;
  start = Clock::now();
  const std::size_t firstPuffs = sky.update(test::flightCamera(0, sideMeters)).puffs.size();
  const double firstFrame = millisecondsSince(start);
  std::vector<double> frames(kFrames, 1e9), naiveFrames;
  Naive naive(sky.pack());
  std::size_t drawn = 0, lists = 0;
  float orderError = 0;
  // The same flight again and again, each frame at its best: other programs take the machine now and then.
  for (int flight = 0; flight < kFlights; ++flight) {
    sky.update(test::flightCamera(0, sideMeters));
    for (int f = 1; f <= kFrames; ++f) {
      const runtime::Camera camera = test::flightCamera(f, sideMeters);
      start = Clock::now();
      const runtime::Frame frame = sky.update(camera);
      const auto at = static_cast<std::size_t>(f - 1);
      frames[at] = std::min(frames[at], millisecondsSince(start));
      if (flight > 0) continue;
      drawn += frame.puffs.size();
      lists += frame.puffsChanged;
      orderError = std::max(orderError, frame.orderErrorMeters);
    }
  }
  // Apart, so that neither empties the other's caches.
  for (int f = 0; f < kFrames; f += kNaiveEvery) {
    start = Clock::now();
    naive.frame(test::flightCamera(f, sideMeters));
    naiveFrames.push_back(millisecondsSince(start));
  }
  const Times ours = timesOf(frames), theirs = timesOf(naiveFrames), open = timesOf(openings);
  const nlohmann::ordered_json line{{"case", "flight"},
                                    {"clouds", clouds},
                                    {"puffs", naive.puffs()},
                                    {"archetypes", archetypes},
                                    {"side_km", sideMeters / 1000},
                                    {"pack_bytes", std::filesystem::file_size(file)},
                                    {"open_ms", open.median},
                                    {"open_and_light_ms", ready},
                                    {"colours", sky.lighting().colors().size()},
                                    {"sun_update_ms", sunUpdate},
                                    {"first_frame_ms", firstFrame},
                                    {"first_frame_puffs", firstPuffs},
                                    {"frame_ms", ours.mean},
                                    {"frame_median_ms", ours.median},
                                    {"frame_worst_ms", ours.worst},
                                    {"worst_over_mean", ours.worst / ours.mean},
                                    {"drawn_puffs", drawn / kFrames},
                                    {"lists", lists},
                                    {"order_error_m", orderError},
                                    {"sort_all_ms", theirs.mean},
                                    {"times_faster", theirs.mean / ours.mean}};
  std::printf("%s\n", line.dump().c_str());
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 1) {
    run(25'000, 40, 48, 400'000);
    run(2'500, 40, 48, 130'000);
    run(25'000, 40, 48, 150'000);
    return 0;
  }
  for (int i = 1; i + 3 < count; i += 4)
    run(std::atoi(arguments[i]), std::atoi(arguments[i + 1]), std::atoi(arguments[i + 2]),
        1000 * static_cast<float>(std::atof(arguments[i + 3])));
  return 0;
}
