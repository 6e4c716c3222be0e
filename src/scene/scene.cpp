// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace cloudgen::scene {

std::uint64_t drawnPuffs(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.lit[instance.lit].puffs.size();
  return count;
}

float yawRadians(int yawStep) { return static_cast<float>(yawStep * 2.0 * std::numbers::pi / kYawSteps); }

namespace {

/// The rotation of a step of yaw.
const glm::quat& turnOf(int yawStep) {
  static const auto kTurns = [] {
    std::array<glm::quat, kYawSteps> turns;
    for (int step = 0; step < kYawSteps; ++step)
      turns[static_cast<std::size_t>(step)] = glm::angleAxis(yawRadians(step), glm::vec3(0, 1, 0));
    return turns;
  }();
  return kTurns[static_cast<std::size_t>(yawStep)];
}

}  // namespace

shape::Puff placed(const Scene& scene, const Instance& instance, const shape::Puff& puff) {
  const glm::quat& turn = turnOf(scene.lit[instance.lit].yawStep);
  shape::Puff out = puff;
  out.center = instance.position + turn * (puff.center * instance.scale);
  out.sigma = puff.sigma * instance.scale;
  out.rotation = turn * puff.rotation;
  out.extinctionPerMeter = puff.extinctionPerMeter * instance.opticalDepthFactor / instance.scale;
  return out;
}

shape::Bounds boundsOf(const Scene& scene, const Instance& instance) {
  const shape::Bounds& box = scene.archetypes[scene.lit[instance.lit].archetype].bounds;
  const glm::vec3 half = glm::max(glm::abs(box.lower), glm::abs(box.upper)) * instance.scale;
  const float reach = std::hypot(half.x, half.z);
  return {instance.position + glm::vec3(-reach, box.lower.y * instance.scale, -reach),
          instance.position + glm::vec3(reach, box.upper.y * instance.scale, reach)};
}

std::vector<Instance> instancesAt(const Scene& scene, double seconds) {
  std::vector<Instance> instances = scene.instances;
  const std::vector<double>& keys = scene.keySeconds;
  if (keys.empty()) return instances;
  const double time = std::clamp(seconds, keys.front(), keys.back());
  const auto after = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(1, std::lower_bound(keys.begin(), keys.end(), time) - keys.begin()));
  const std::size_t to = std::min(after, keys.size() - 1), from = to == 0 ? 0 : to - 1;
  const float share = to > from ? static_cast<float>((time - keys[from]) / (keys[to] - keys[from])) : 0.0f;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Motion& motion = scene.motions[i];
    const auto at = [&](std::size_t key) -> const Moment* {
      return key >= motion.firstKey && key < motion.firstKey + motion.moments.size()
                 ? &motion.moments[key - motion.firstKey]
                 : nullptr;
    };
    const Moment *a = at(from), *b = at(to);
    Instance& cloud = instances[i];
    if (!a || !b) {
      cloud.opticalDepthFactor = 0;
      continue;
    }
    cloud.position += a->shift + share * (b->shift - a->shift);
    cloud.scale *= a->growth + share * (b->growth - a->growth);
    cloud.opticalDepthFactor *= a->presence + share * (b->presence - a->presence);
  }
  return instances;
}

Scene standingAt(const Scene& scene, double seconds) {
  Scene still = scene;
  still.validTime.seconds += std::llround(seconds);
  still.keySeconds.clear(), still.timeSeconds.clear(), still.motions.clear();
  still.instances.clear(), still.clouds.clear();
  const std::vector<Instance> moved = instancesAt(scene, seconds);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (!(moved[i].opticalDepthFactor > 0)) continue;
    still.instances.push_back(moved[i]);
    if (i < scene.clouds.size()) still.clouds.push_back(scene.clouds[i]);
  }
  return still;
}

float groundAt(const Scene& scene, double x, double z) {
  if (scene.terrain.empty() || !scene.terrain.covers(x, z)) return scene.groundHeightMeters;
  return std::max(scene.groundHeightMeters, static_cast<float>(scene.terrain.heightAt(x, z)));
}

base::HeightField flatGround(const Scene& scene, int cells) {
  const glm::dvec2 lower = scene.frame.lowerCorner(), upper = scene.frame.upperCorner();
  const auto points = static_cast<std::size_t>(cells + 1);
  return {cells + 1, cells + 1, lower, (upper - lower) / static_cast<double>(cells),
          std::vector<float>(points * points, scene.groundHeightMeters)};
}

float highestTop(const Scene& scene) {
  float top = 0;
  for (const CloudRecord& cloud : scene.clouds) top = std::max(top, cloud.topMeters);
  return top;
}

std::vector<Tile> tilesOf(const Scene& scene, float sideMeters) {
  std::map<std::pair<int, int>, Tile> tiles;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const int column = static_cast<int>(std::floor(instance.position.x / sideMeters));
    const int row = static_cast<int>(std::floor(instance.position.z / sideMeters));
    const auto [found, isNew] = tiles.try_emplace({row, column});
    Tile& tile = found->second;
    if (isNew) tile = {column, row, glm::vec3(1e30f), glm::vec3(-1e30f), {}};
    const shape::Bounds box = boundsOf(scene, instance);
    tile.lower = glm::min(tile.lower, box.lower);
    tile.upper = glm::max(tile.upper, box.upper);
    tile.instances.push_back(i);
  }
  std::vector<Tile> out;
  for (auto& [key, tile] : tiles) out.push_back(std::move(tile));
  return out;
}

std::vector<Tile> tilesOf(const Scene& scene) {
  if (scene.instances.empty()) return {};
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const Instance& instance : scene.instances) {
    lower = glm::min(lower, instance.position);
    upper = glm::max(upper, instance.position);
  }
  float sideMeters = std::max({(upper.x - lower.x) / 4, (upper.z - lower.z) / 4, 1000.0f});
  auto tiles = tilesOf(scene, sideMeters);
  while (tiles.size() > kMostTiles) tiles = tilesOf(scene, sideMeters *= 1.1f);
  return tiles;
}

}  // namespace cloudgen::scene
